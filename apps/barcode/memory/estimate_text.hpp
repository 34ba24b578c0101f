// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "barcode/complex/build_complex.hpp"
#include "ph/estimate.hpp"

namespace ph::barcode {

/// Whether edges are collapsed first, and why; only said of Rips complexes.
std::string collapse_text(const RunPlan& plan);

/// What --dry-run prints. @param taken bytes that reading and building took.
std::string estimate_text(const Estimate& estimate, const BuiltComplex& built,
                          const std::string& description, double taken);

}  // namespace ph::barcode
