// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/detail/diagram/point_tree.hpp"

namespace ph::diagram {

/// The remaining points of a tree, in the maximum metric. Each node has one byte. The byte of a
/// leaf has one bit per point. The byte of an inner node is zero if and only if no point is left.
/// Distances are exactly the distances that `distance` computes.
class PointsLeft {
 public:
  using Position = PointTree::Position;

  /// Starts with all points left. @param tree must outlive this object.
  PointsLeft(const PointTree& tree, const RunContext& context);

  void restore_all() { left_ = all_; }
  /// Does the same as calling `restore_all` and then `remove` for each point that `is_left`
  /// rejects, but in O(n).
  template <class IsLeft>
  void restore(IsLeft&& is_left) {
    for (Node node = tree_.node_count() - 1; node > 0; --node) {
      std::uint8_t& left = left_[node];
      if (!tree_.is_leaf(node)) {
        left = left_[2 * node] | left_[2 * node + 1];
        continue;
      }
      left = 0;
      const Position begin = tree_.begin(node), end = tree_.end(node);
      for (Position q = begin; q < end; ++q)
        if (is_left(q)) left |= static_cast<std::uint8_t>(1U << (q - begin));
    }
  }
  bool has(Position q) const {
    const Node leaf = tree_.leaf_of(q);
    return (left_[leaf] >> (q - tree_.begin(leaf)) & 1U) != 0;
  }
  void remove(Position q);
  /// Removes one remaining point at a distance of at most `radius` from p. Tries positions close to
  /// `near` first. @return the position of that point, or kNone if no such point remains.
  Position take(const Point& p, double radius, Position near);

  /// Removes all points at a distance of at most `radius` from p, and calls `visit(position)` for
  /// each of them.
  template <class Visit>
  void take_all(const Point& p, double radius, Visit&& visit) {
    if (left_[1] != 0 && tree_.distance_to_box(p, 1) <= radius) take_all_below(1, p, radius, visit);
  }

  struct Nearest {
    double distance;
    Position position = kNone;
  };
  /// The nearest remaining point. If no point is closer than `limit`, only `limit` is returned.
  Nearest nearest(const Point& p, double limit) const {
    Nearest best{limit};
    if (left_[1] != 0 && tree_.distance_to_box(p, 1) < limit) nearest(1, p, best);
    return best;
  }

 private:
  using Node = PointTree::Node;

  /// Updates the ancestors of a node, up to the first ancestor that still has points. Must be
  /// called when the byte of the node may have become zero.
  void empty_above(Node node) {
    while (node > 1 && left_[node] == 0) {
      node /= 2;
      left_[node] = left_[2 * node] | left_[2 * node + 1];
    }
  }
  Position take_below(Node node, const Point& p, double radius);
  template <class Visit>
  void take_all_below(Node node, const Point& p, double radius, Visit& visit) {
    if (tree_.is_leaf(node)) {
      const Position begin = tree_.begin(node);
      for (unsigned left = left_[node]; left != 0; left &= left - 1) {
        const Position q = begin + static_cast<Position>(std::countr_zero(left));
        if (distance(p, tree_.point(q)) > radius) continue;
        left_[node] &= static_cast<std::uint8_t>(~(left & -left));
        visit(q);
      }
      return;
    }
    for (const Node child : {2 * node, 2 * node + 1})
      if (left_[child] != 0 && tree_.distance_to_box(p, child) <= radius)
        take_all_below(child, p, radius, visit);
    left_[node] = left_[2 * node] | left_[2 * node + 1];
  }
  void nearest(Node node, const Point& p, Nearest& best) const;

  const PointTree& tree_;
  std::pmr::vector<std::uint8_t> left_, all_;
};

}  // namespace ph::diagram
