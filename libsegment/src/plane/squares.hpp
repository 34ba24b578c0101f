// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// A plane divided into squares. @param edge the length of a square's side, metres.
class Squares {
 public:
  Squares(const Plane& plane, double edge) : edge_(edge) {
    const Eigen::Vector3d n(plane.normal[0], plane.normal[1], plane.normal[2]);
    across_ = n.unitOrthogonal();
    along_ = n.cross(across_);
  }
  /// The column and the row, as whole numbers, of the square below a point.
  std::array<double, 2> of(const Eigen::Vector3d& p) const {
    return {std::floor(across_.dot(p) / edge_), std::floor(along_.dot(p) / edge_)};
  }

 private:
  double edge_;
  Eigen::Vector3d across_, along_;
};

}  // namespace ph::segment
