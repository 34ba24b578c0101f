// SPDX-License-Identifier: MIT
#pragma once
// This header makes parts of a barcode, and barcodes from parts, for selections and for pickle.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <vector>

#include "python/src/results/bars.hpp"

namespace ph::python {

/// The bars at these indices, in this order, with all their data.
/// @param places ascending. @throws Error (usage) on an index out of range.
Bars selected(const Bars& bars, const std::vector<std::int64_t>& places);

/// Converts a barcode, without the facts about its computation, to a dictionary of arrays and plain
/// values, and back.
/// @throws Error (bad_data) on an invalid state.
pybind11::dict state_of(const Bars& bars);
Bars bars_of_state(const pybind11::dict& state);

}  // namespace ph::python
