// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/points.hpp"

namespace ph::test {

/// Copies point j of `from` to point i of `to`.
inline void copy_point(PointsView from, Index j, Points& to, Index i) {
  std::copy_n(from.row(j), from.cols(), to.row(i).begin());
}

inline void scale(std::span<double> coordinates, double factor) {
  for (double& x : coordinates) x *= factor;
}

inline Points scaled(Points points, double factor) {
  for (Index i = 0; i < points.rows(); ++i) scale(points.row(i), factor);
  return points;
}

}  // namespace ph::test
