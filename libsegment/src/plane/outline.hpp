// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

namespace ph::segment {

/// Points of a plane, or the corners of a polygon, counterclockwise.
using Outline = std::vector<Eigen::Vector2d>;

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The convex hull of some points, counterclockwise (A. M. Andrew, Another efficient algorithm for
/// convex hulls in two dimensions, 1979).
inline Outline hull_of(Outline points) {
  if (points.size() < 3) return points;
  std::ranges::sort(points, {}, [](const Eigen::Vector2d& p) { return std::pair(p.x(), p.y()); });
  Outline hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

/// The area of a polygon.
inline double area_of(const Outline& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

}  // namespace ph::segment
