// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The rotation that turns `up`, a unit vector, into the z axis. The directions of x and y are
/// arbitrary.
inline Eigen::Matrix3d upright(const Vec3& up) {
  const Eigen::Vector3d normal(up.data());
  Eigen::Matrix3d turn;
  turn.row(0) = normal.unitOrthogonal();
  turn.row(1) = normal.cross(turn.row(0));
  turn.row(2) = normal;
  return turn;
}

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
