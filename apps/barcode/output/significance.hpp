// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "ph/barcode.hpp"
#include "ph/io/write.hpp"
#include "ph/significance.hpp"

namespace ph::barcode {

/// Must be called before the computation. @throws Error (usage) if the requested p-values would be
/// meaningless or no output has room for them.
void require_significance(BarcodeFormat format, const Job& job);

/// For each bar, its p-value multiplied by the number of tested bars of its dimension, but at most
/// 1. The number is NaN for components, for bars that never die and for bars of length 0.
/// @param filtration the filtration of the bars.
std::vector<double> p_values_of(const Barcode& barcode, DistanceFiltration filtration);

}  // namespace ph::barcode
