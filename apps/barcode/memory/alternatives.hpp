// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "barcode/run.hpp"

namespace ph::barcode {

/// For a job that ran out of memory: changes of the command line with which it fits, as an estimate
/// of each says; the complex of each was built within the limit. Reads the input again.
/// @return "what would fit: " and at most three, or "what may fit: " of an image; empty if none is
/// known.
std::string alternatives(const Job& job, const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
