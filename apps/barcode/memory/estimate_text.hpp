// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/complex/build_complex.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/common/run/session.hpp"
#include "ph/estimate.hpp"

namespace ph::barcode {

/// The output of --dry-run. @param taken the number of bytes that reading the data and building the
/// complex used.
std::string estimate_text(const Estimate& estimate, const BuiltComplex& built,
                          const std::string& description, double taken);

/// For a job that ran out of memory, finds changes to the command line with which the job should
/// fit. Reads the input again, builds the complex for each change within the limit, and estimates
/// the memory of its computation.
/// @return "what would fit: " or, for an image, "what may fit: ", followed by at most three
/// changes. Empty if no change is known.
std::string alternatives(const Job& job, app::Session& session);

}  // namespace ph::barcode
