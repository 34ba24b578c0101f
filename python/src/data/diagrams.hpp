// SPDX-License-Identifier: MIT
#pragma once
// This header converts diagrams from Python, which are float64 arrays with rows birth, death.
#include <pybind11/pybind11.h>

#include <span>
#include <vector>

#include "ph/barcode.hpp"

namespace ph::python {

namespace py = pybind11;

/// The rows, as bars of dimension 0.
std::vector<Bar> bars_of(const py::buffer& array);

/// Diagrams from arrays, in the form that the library expects.
struct Diagrams {
  explicit Diagrams(const std::vector<py::buffer>& arrays) {
    for (const py::buffer& array : arrays) all.push_back(bars_of(array));
  }
  std::vector<std::span<const Bar>> spans() const { return {all.begin(), all.end()}; }

  std::vector<std::vector<Bar>> all;
};

}  // namespace ph::python
