// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "barcode/complex/build_complex.hpp"
#include "ph/estimate.hpp"

namespace ph::barcode {

/// What --dry-run prints. @param taken bytes that reading and building took.
std::string estimate_text(const Estimate& estimate, const BuiltComplex& built,
                          const std::string& description, double taken);

}  // namespace ph::barcode
