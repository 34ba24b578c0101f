// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

#include "ph/detail/diagram/point_tree.hpp"

namespace ph::diagram {

/// The cost of a pair and of a bar without a partner: the distance in the ground norm to the power
/// of the order.
class GroundCost {
 public:
  /// @param order at least 1, finite. @param ground at least 1, or infinity.
  /// @param unit the unit of distances before they are raised to the power; ignored for orders 1
  /// and 2.
  GroundCost(double order, double ground, double unit = 1)
      : order_(order), ground_(ground), unit_(unit), to_diagonal_(to_diagonal(ground)) {}

  /// The distance of a bar from the diagonal, as a multiple of half its length.
  static double to_diagonal(double ground) {
    return std::isinf(ground) ? 1 : std::pow(2, 1 / ground);  // mutant: diagonal-norm
  }
  /// The distance between the two points of a pair, not raised to the power. It is correct in any
  /// unit, because squares neither overflow nor underflow.
  double distance(const Point& p, const Point& q) const {
    const double x = std::abs(p[0] - q[0]), y = std::abs(p[1] - q[1]);
    return ground_ == 2 ? std::hypot(x, y) : norm(x, y);
  }
  double distance_alone(const Point& p) const {
    const double length = p[1] - p[0];
    return to_diagonal_ * (std::isinf(length) ? p[1] / 2 - p[0] / 2 : length / 2);
  }

  double pair(const Point& p, const Point& q) const {
    return power(norm(std::abs(p[0] - q[0]), std::abs(p[1] - q[1])));
  }
  /// The cost of moving to the nearest point of the diagonal.
  double alone(const Point& p) const { return power(to_diagonal_ * ((p[1] - p[0]) / 2)); }
  /// A lower bound on the cost of pairing p with a point in the box of a node of a tree.
  double pair_with_box(const Point& p, const double* box) const {
    return power(norm(std::max({0.0, box[0] - p[0], p[0] - box[1]}),
                      std::max({0.0, box[2] - p[1], p[1] - box[3]})));
  }
  double power(double distance) const {
    if (order_ == 1) return distance;
    return order_ == 2 ? distance * distance : std::pow(distance / unit_, order_);
  }
  double root(double cost) const {
    if (order_ == 1) return cost;
    return order_ == 2 ? std::sqrt(cost) : unit_ * std::pow(cost, 1 / order_);
  }

 private:
  double norm(double x, double y) const {
    if (std::isinf(ground_)) return std::max(x, y);
    if (ground_ == 2) return std::sqrt(x * x + y * y);
    if (ground_ == 1) return x + y;
    const double larger = std::max(x, y);
    if (larger == 0 || std::isinf(larger)) return larger;
    return larger * std::pow(1 + std::pow(std::min(x, y) / larger, ground_), 1 / ground_);
  }

  double order_, ground_, unit_, to_diagonal_;
};

}  // namespace ph::diagram
