// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "ph/detail/metric/kd_tree.hpp"

namespace ph::diagram {

/// The birth and the death of a bar, both finite.
using Point = std::array<double, 2>;

/// Stands for no point, or no partner.
inline constexpr std::uint32_t kNone = UINT32_MAX;

inline double distance(const Point& p, const Point& q) {
  return std::max(std::abs(p[0] - q[0]), std::abs(p[1] - q[1]));
}

/// The distance of a bar from the diagonal.
inline double to_diagonal(const Point& p) {
  const double length = p[1] - p[0];
  return std::isfinite(length) ? length / 2 : p[1] / 2 - p[0] / 2;
}

/// The points of a diagram in a k-d tree. Points are named by their positions in the order of the
/// tree: neighbours in space are close in memory.
class PointTree {
 public:
  using Node = KdTree::Node;
  using Position = KdTree::Position;

  /// @param points at least one, fewer than 2^32 - 1.
  PointTree(std::span<const Point> points, const RunContext& context);

  std::size_t size() const { return tree_.size(); }
  const Point& point(Position q) const { return points_[q]; }
  /// The place of each point in the input, by the point's position in the tree.
  std::span<const std::uint32_t> places() const { return tree_.rows(); }

  Node node_count() const { return tree_.node_count(); }
  bool is_leaf(Node node) const { return tree_.is_leaf(node); }
  Position begin(Node leaf) const { return tree_.begin(leaf); }
  Position end(Node leaf) const { return tree_.end(leaf); }
  Node leaf_of(Position q) const {
    const std::uint64_t leaves = tree_.first_leaf();
    return static_cast<Node>(leaves + ((q + std::uint64_t{1}) * leaves - 1) / size());
  }
  /// Smallest and largest birth, smallest and largest death.
  const double* box(Node node) const { return tree_.box(node); }
  /// The distance from p to the node's box in the maximum metric. Rounding is monotone; therefore
  /// the computed distance to a point of the node is never smaller.
  double distance_to_box(const Point& p, Node node) const {
    const double* const b = box(node);
    return std::max({0.0, b[0] - p[0], p[0] - b[1], b[2] - p[1], p[1] - b[3]});
  }

 private:
  const KdTree tree_;
  std::pmr::vector<Point> points_;  // the points, by position
};

}  // namespace ph::diagram
