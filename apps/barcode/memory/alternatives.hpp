// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "barcode/arguments/arguments.hpp"
#include "barcode/job/job.hpp"
#include "common/run/session.hpp"

namespace ph::barcode {

/// For a job that ran out of memory: changes of the command line with which it should fit,
/// according to an estimate of each; the complex of each change was built within the limit. Reads
/// the input again.
/// @return "what would fit: " and at most three changes, or "what may fit: " for an image; empty if
/// none is known.
std::string alternatives(const Job& job, const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
