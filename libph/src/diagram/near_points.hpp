// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ph::diagram {

/// Birth and death of a bar, both finite.
using Point = std::array<double, 2>;

inline double distance(const Point& p, const Point& q) {
  return std::max(std::abs(p[0] - q[0]), std::abs(p[1] - q[1]));
}

/// A k-d tree of points of a diagram, in the maximum metric, from which points are taken away.
/// Distances are those of `distance`, to the last digit. The points outlive it.
class NearPoints {
 public:
  /// @param chosen the points that it has, each once.
  NearPoints(std::span<const Point> points, std::vector<std::uint32_t> chosen);

  /// Takes a point at a distance of `radius` or less away: which one is not said. Nothing if there
  /// is none left.
  std::optional<std::uint32_t> take(const Point& p, double radius) {
    return ids_.empty() ? std::nullopt : take(0, p, radius);
  }
  /// The distance of the nearest point that is left, or `limit` if it is nearer.
  double nearest(const Point& p, double limit) const {
    return ids_.empty() ? limit : nearest(0, p, limit);
  }

 private:
  // Node i has the children 2 i + 1 and 2 i + 2; a leaf keeps its points that are left in front.
  struct Node {
    Point low, high;
    std::uint32_t begin, end, left;  // in ids_; how many are left
  };
  bool is_leaf(const Node& node) const { return node.end - node.begin <= kLeaf; }
  void build(std::size_t i, std::uint32_t begin, std::uint32_t end);
  std::optional<std::uint32_t> take(std::size_t i, const Point& p, double radius);
  double nearest(std::size_t i, const Point& p, double limit) const;

  static constexpr std::uint32_t kLeaf = 8;

  std::span<const Point> points_;
  std::vector<std::uint32_t> ids_;
  std::vector<Node> nodes_;
};

}  // namespace ph::diagram
