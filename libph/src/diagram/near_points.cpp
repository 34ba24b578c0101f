// SPDX-License-Identifier: MIT
#include "diagram/near_points.hpp"

#include <utility>

namespace ph::diagram {
namespace {

/// Rounding keeps the order of distances, so no point within is nearer than this.
double distance_to_box(const Point& p, const Point& low, const Point& high) {
  double result = 0;
  for (const std::size_t k : {0U, 1U}) result = std::max({result, low[k] - p[k], p[k] - high[k]});
  return result;
}

}  // namespace

NearPoints::NearPoints(std::span<const Point> points, std::vector<std::uint32_t> chosen)
    : points_(points), ids_(std::move(chosen)) {
  if (!ids_.empty()) build(0, 0, static_cast<std::uint32_t>(ids_.size()));
}

void NearPoints::build(std::size_t i, std::uint32_t begin, std::uint32_t end) {
  if (nodes_.size() <= i) nodes_.resize(i + 1);
  Node node{points_[ids_[begin]], points_[ids_[begin]], begin, end, end - begin};
  for (std::uint32_t at = begin; at < end; ++at)
    for (const std::size_t k : {0U, 1U}) {
      node.low[k] = std::min(node.low[k], points_[ids_[at]][k]);
      node.high[k] = std::max(node.high[k], points_[ids_[at]][k]);
    }
  nodes_[i] = node;
  if (is_leaf(node)) return;
  const std::size_t axis = node.high[1] - node.low[1] > node.high[0] - node.low[0] ? 1 : 0;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      ids_.begin() + begin, ids_.begin() + middle, ids_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
  build(2 * i + 1, begin, middle);
  build(2 * i + 2, middle, end);
}

std::optional<std::uint32_t> NearPoints::take(std::size_t i, const Point& p, double radius) {
  Node& node = nodes_[i];
  if (node.left == 0 || distance_to_box(p, node.low, node.high) > radius) return std::nullopt;
  if (!is_leaf(node)) {
    for (const std::size_t child : {2 * i + 1, 2 * i + 2})
      if (const auto found = take(child, p, radius)) {
        --nodes_[i].left;
        return found;
      }
    return std::nullopt;
  }
  for (std::uint32_t at = node.begin; at < node.begin + node.left; ++at) {
    const std::uint32_t id = ids_[at];
    if (distance(p, points_[id]) > radius) continue;
    --node.left;
    std::swap(ids_[at], ids_[node.begin + node.left]);
    return id;
  }
  return std::nullopt;
}

double NearPoints::nearest(std::size_t i, const Point& p, double limit) const {
  const Node& node = nodes_[i];
  if (node.left == 0 || distance_to_box(p, node.low, node.high) >= limit) return limit;
  if (is_leaf(node)) {
    for (std::uint32_t at = node.begin; at < node.begin + node.left; ++at)
      limit = std::min(limit, distance(p, points_[ids_[at]]));
    return limit;
  }
  std::array<std::size_t, 2> children = {2 * i + 1, 2 * i + 2};
  const auto to_child = [&](std::size_t child) {
    return distance_to_box(p, nodes_[child].low, nodes_[child].high);
  };
  if (to_child(children[1]) < to_child(children[0])) std::swap(children[0], children[1]);
  for (const std::size_t child : children) limit = nearest(child, p, limit);
  return limit;
}

}  // namespace ph::diagram
