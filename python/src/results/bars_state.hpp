// SPDX-License-Identifier: MIT
#pragma once
// Parts of a barcode, and barcodes of parts: for selections and for pickle.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <vector>

#include "results/bars.hpp"

namespace ph::python {

/// The bars at these places, in this order, with all that belongs to them.
/// @param places ascending. @throws Error (usage) on one that is not there.
Bars selected(const Bars& bars, const std::vector<std::int64_t>& places);

/// All but the facts as a dictionary of arrays and plain values, and back.
/// @throws Error (bad_data) on what cannot be such a state.
pybind11::dict state_of(const Bars& bars);
Bars bars_of_state(const pybind11::dict& state);

}  // namespace ph::python
