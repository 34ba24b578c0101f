// SPDX-License-Identifier: MIT
#include "python/src/data/diagrams.hpp"

#include "python/src/data/arrays.hpp"

namespace ph::python {

std::vector<Bar> bars_of(const py::buffer& array) {
  const py::buffer_info info = array.request();
  const PointsView rows = points_of(info);
  std::vector<Bar> bars;
  bars.reserve(static_cast<std::size_t>(rows.rows()));
  for (Index i = 0; i < rows.rows(); ++i) bars.push_back({0, rows(i, 0), rows(i, 1)});
  return bars;
}

}  // namespace ph::python
