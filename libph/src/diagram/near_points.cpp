// SPDX-License-Identifier: MIT
#include "diagram/near_points.hpp"

#include <numeric>
#include <utility>

namespace ph::diagram {
namespace {

std::vector<std::uint32_t> first_numbers(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

}  // namespace

NearPoints::NearPoints(std::span<const Point> points, const RunContext& context)
    : tree_({points.front().data(), static_cast<Index>(points.size()), 2},
            first_numbers(points.size()), context),
      label_(points.size(), 0, &context.memory),
      below_(tree_.node_count(), set_of(0), &context.memory) {}

void NearPoints::label_all(Label label) {
  std::ranges::fill(label_, label);
  std::ranges::fill(below_, set_of(label));
}

std::optional<std::uint32_t> NearPoints::relabel(Node node, const Point& p, double radius,
                                                 Label from, Label to) {
  if ((below_[node] & set_of(from)) == 0 || distance_to_box(p, node) > radius) return std::nullopt;
  if (!tree_.is_leaf(node)) {
    for (const Node child : {2 * node, 2 * node + 1})
      if (const auto found = relabel(child, p, radius, from, to)) {
        below_[node] = below_[2 * node] | below_[2 * node + 1];
        return found;
      }
    return std::nullopt;
  }
  const Position begin = tree_.begin(node), end = tree_.end(node);
  for (Position q = begin; q < end; ++q) {
    if (label_[q] != from || distance(p, point(q)) > radius) continue;
    label_[q] = to;
    below_[node] = 0;
    for (Position other = begin; other < end; ++other) below_[node] |= set_of(label_[other]);
    return tree_.rows()[q];
  }
  return std::nullopt;
}

double NearPoints::nearest(Node node, const Point& p, double limit) const {
  if (distance_to_box(p, node) >= limit) return limit;
  if (tree_.is_leaf(node)) {
    for (Position q = tree_.begin(node); q < tree_.end(node); ++q)
      limit = std::min(limit, distance(p, point(q)));
    return limit;
  }
  Node near = 2 * node, far = near + 1;
  if (distance_to_box(p, far) < distance_to_box(p, near)) std::swap(near, far);
  return nearest(far, p, nearest(near, p, limit));
}

}  // namespace ph::diagram
