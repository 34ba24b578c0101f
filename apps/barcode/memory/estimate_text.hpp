// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/complex/build_complex.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/common/run/session.hpp"
#include "ph/estimate.hpp"

namespace ph::barcode {

/// What --dry-run prints. @param taken bytes that reading and building took.
std::string estimate_text(const Estimate& estimate, const BuiltComplex& built,
                          const std::string& description, double taken);

/// For a job that ran out of memory: changes of the command line with which it should fit,
/// according to an estimate of each; the complex of each change was built within the limit. Reads
/// the input again.
/// @return "what would fit: " and at most three changes, or "what may fit: " for an image; empty if
/// none is known.
std::string alternatives(const Job& job, app::Session& session);

}  // namespace ph::barcode
