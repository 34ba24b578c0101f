// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <vector>

namespace ph::segment {

/// The upper end of an object, seen from above.
struct UpperEnd {
  /// The height of the upper end. One point in fifty may be higher.
  double top = 0;
  /// X and y of the points less than a depth below the top.
  std::vector<Eigen::Vector2d> points;
};

/// Finds the upper end of an object. @param points the points of the object, upright, in metres; at
/// least one.
/// @param depth the depth of the upper end, in metres.
UpperEnd upper_end_of(const std::vector<Eigen::Vector3d>& points, double depth);

}  // namespace ph::segment
