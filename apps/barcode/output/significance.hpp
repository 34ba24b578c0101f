// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "barcode/arguments/arguments.hpp"
#include "ph/barcode.hpp"
#include "ph/io/write.hpp"
#include "ph/significance.hpp"

namespace ph::barcode {

/// Before anything is computed. @throws Error (usage) if p-values are asked for that have no place,
/// or that would mean nothing.
void require_significance(BarcodeFormat format, const Arguments& arguments);

/// By bar its p-value, times the number of bars of its dimension that were tested; NaN of
/// components and of bars that never die.
/// @param filtration what the bars are of.
std::vector<double> p_values_of(const Barcode& barcode, DistanceFiltration filtration);

}  // namespace ph::barcode
