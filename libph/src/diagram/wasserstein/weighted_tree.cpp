// SPDX-License-Identifier: MIT
#include "libph/src/diagram/wasserstein/weighted_tree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ph::diagram {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

WeightedTree::WeightedTree(const PointTree& tree, const GroundCost& cost, const RunContext& context)
    : tree_(tree),
      cost_(cost),
      weights_(tree.size(), -kNever, &context.memory),
      largest_(tree.node_count(), -kNever, &context.memory) {}

void WeightedTree::set(Position q, double weight) {
  weights_[q] = weight;
  Node node = tree_.leaf_of(q);
  const auto begin = weights_.begin() + tree_.begin(node), end = weights_.begin() + tree_.end(node);
  double largest = *std::max_element(begin, end);
  while (largest_[node] != largest) {
    largest_[node] = largest;
    if (node == 1) return;
    node /= 2;
    largest = std::max(largest_[2 * node], largest_[2 * node + 1]);
  }
}

WeightedTree::Best WeightedTree::best_two(const Point& p, Position near) const {
  Best best{kNever, kNever};
  Node node = tree_.leaf_of(near);
  best_below(node, p, best);
  for (; node > 1; node /= 2)
    if (least(p, node ^ 1U) < best.second) best_below(node ^ 1U, p, best);
  return best;
}

void WeightedTree::best_below(Node node, const Point& p, Best& best) const {
  if (tree_.is_leaf(node)) {
    const Position end = tree_.end(node);
    for (Position q = tree_.begin(node); q < end; ++q) {
      const double value = cost_.pair(p, tree_.point(q)) - weights_[q];
      if (value < best.first)
        best = {value, best.first, q};  // mutant: auction-second
      else
        best.second = std::min(best.second, value);
    }
    return;
  }
  Node near = 2 * node, far = near + 1;
  double of_near = least(p, near), of_far = least(p, far);
  if (of_far < of_near) {
    std::swap(near, far);
    std::swap(of_near, of_far);
  }
  if (of_near < best.second) best_below(near, p, best);
  if (of_far < best.second) best_below(far, p, best);
}

}  // namespace ph::diagram
