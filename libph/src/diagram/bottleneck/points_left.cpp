// SPDX-License-Identifier: MIT
#include "libph/src/diagram/bottleneck/points_left.hpp"

#include <utility>

namespace ph::diagram {

static_assert(KdTree::kLeafSize <= 8, "a byte has a bit for each point of a leaf");

PointsLeft::PointsLeft(const PointTree& tree, const RunContext& context)
    : tree_(tree), left_(tree.node_count(), &context.memory), all_(&context.memory) {
  restore([](Position) { return true; });
  all_ = left_;
}

void PointsLeft::remove(Position q) {
  const Node leaf = tree_.leaf_of(q);
  left_[leaf] &= static_cast<std::uint8_t>(~(1U << (q - tree_.begin(leaf))));
  empty_above(leaf);
}

PointsLeft::Position PointsLeft::take(const Point& p, double radius, Position near) {
  Node node = tree_.leaf_of(near);
  Position q = left_[node] == 0 ? kNone : take_below(node, p, radius);
  for (; q == kNone && node > 1; node /= 2) {
    const Node sibling = node ^ 1U;
    if (left_[sibling] == 0 || tree_.distance_to_box(p, sibling) > radius) continue;
    q = take_below(sibling, p, radius);
    if (q != kNone) {
      empty_above(sibling);
      return q;
    }
  }
  if (q != kNone) empty_above(node);
  return q;
}

PointsLeft::Position PointsLeft::take_below(Node node, const Point& p, double radius) {
  if (tree_.is_leaf(node)) {
    const Position begin = tree_.begin(node);
    for (unsigned left = left_[node]; left != 0; left &= left - 1) {
      const Position q = begin + static_cast<Position>(std::countr_zero(left));
      if (distance(p, tree_.point(q)) > radius) continue;  // mutant: bottleneck-radius
      left_[node] &= static_cast<std::uint8_t>(~(left & -left));
      return q;
    }
    return kNone;
  }
  for (const Node child : {2 * node, 2 * node + 1}) {
    if (left_[child] == 0 || tree_.distance_to_box(p, child) > radius) continue;
    const Position q = take_below(child, p, radius);
    if (q == kNone) continue;
    left_[node] = left_[2 * node] | left_[2 * node + 1];  // mutant: bottleneck-node
    return q;
  }
  return kNone;
}

void PointsLeft::nearest(Node node, const Point& p, Nearest& best) const {
  if (tree_.is_leaf(node)) {
    const Position begin = tree_.begin(node);
    for (unsigned left = left_[node]; left != 0; left &= left - 1) {
      const Position q = begin + static_cast<Position>(std::countr_zero(left));
      const double d = distance(p, tree_.point(q));
      if (d < best.distance) best = {d, q};
    }
    return;
  }
  Node near = 2 * node, far = near + 1;
  double to_near = tree_.distance_to_box(p, near), to_far = tree_.distance_to_box(p, far);
  if (to_far < to_near) {
    std::swap(near, far);
    std::swap(to_near, to_far);
  }
  if (left_[near] != 0 && to_near < best.distance) nearest(near, p, best);
  if (left_[far] != 0 && to_far < best.distance) nearest(far, p, best);
}

}  // namespace ph::diagram
