// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "metric/kd_tree.hpp"

namespace ph::diagram {

/// Birth and death of a bar, both finite.
using Point = std::array<double, 2>;

inline double distance(const Point& p, const Point& q) {
  return std::max(std::abs(p[0] - q[0]), std::abs(p[1] - q[1]));
}

/// The points of a diagram in the maximum metric, each with a label: a k-d tree that finds points
/// of one label. Distances are those of `distance`, to the last digit.
class NearPoints {
 public:
  using Label = std::uint32_t;
  static constexpr Label kNoLabel = UINT32_MAX;  ///< of points that are not looked for any more

  /// @param points at least one. They all get label 0.
  NearPoints(std::span<const Point> points, const RunContext& context);

  void label_all(Label label);
  /// Gives the label `to` to a point of label `from` at a distance of `radius` or less: to which
  /// one is not said. @return its number, or nothing if there is none.
  std::optional<std::uint32_t> relabel(const Point& p, double radius, Label from, Label to) {
    return relabel(1, p, radius, from, to);
  }
  /// The distance of the nearest point, or `limit` if that is less.
  double nearest(const Point& p, double limit) const { return nearest(1, p, limit); }

 private:
  using Node = KdTree::Node;
  using Position = KdTree::Position;
  using Labels = std::uint64_t;  // a set: bit k for all labels that are k modulo 64

  static Labels set_of(Label label) { return label == kNoLabel ? 0 : Labels{1} << (label % 64); }
  Point point(Position q) const {
    const double* const x = tree_.points().row(Index{q});
    return {x[0], x[1]};
  }
  /// Rounding keeps the order of distances, so no point in the box is nearer than this.
  double distance_to_box(const Point& p, Node node) const {
    const double* const box = tree_.box(node);
    return std::max({0.0, box[0] - p[0], p[0] - box[1], box[2] - p[1], p[1] - box[3]});
  }
  std::optional<std::uint32_t> relabel(Node node, const Point& p, double radius, Label from,
                                       Label to);
  double nearest(Node node, const Point& p, double limit) const;

  const KdTree tree_;
  std::pmr::vector<Label> label_;   // by position
  std::pmr::vector<Labels> below_;  // by node: labels of its points
};

}  // namespace ph::diagram
