// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/metric/kd_tree.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph::beta_skeleton {

using Position = KdTree::Position;
using Node = KdTree::Node;
inline constexpr Position kNone = UINT32_MAX;

/// Squares of distances, rounded as in PointMetric. Each square is the sum of the squared
/// differences, axis by axis. Rounding is monotone, and all sums are rounded in the same order.
/// Bounds for boxes therefore hold exactly for the rounded squares of the points in them.
template <int D>
struct Squares {
  [[gnu::always_inline]] static double between(const double* a, const double* b) {
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
  }
  /// The least squared distance from a point to the points in a box, which is given by its smallest
  /// and largest coordinate on each axis.
  [[gnu::always_inline]] static double least(const double* x, const double* box) {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double gap = std::max(0.0, std::max(box[2 * k] - x[k], x[k] - box[2 * k + 1]));
      sum += gap * gap;
    }
    return sum;
  }
  [[gnu::always_inline]] static double largest(const double* x, const double* box) {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double gap = std::max(x[k] - box[2 * k], box[2 * k + 1] - x[k]);
      sum += gap * gap;
    }
    return sum;
  }
  [[gnu::always_inline]] static double least_of_boxes(const double* a, const double* b) {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double gap = std::max(0.0, std::max(b[2 * k] - a[2 * k + 1], a[2 * k] - b[2 * k + 1]));
      sum += gap * gap;
    }
    return sum;
  }
  [[gnu::always_inline]] static double largest_of_boxes(const double* a, const double* b) {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double gap = std::max(b[2 * k + 1] - a[2 * k], a[2 * k + 1] - b[2 * k]);
      sum += gap * gap;
    }
    return sum;
  }
  /// The square of the diagonal of a box.
  [[gnu::always_inline]] static double extent(const double* box) {
    double sum = 0;
    for (int k = 0; k < D; ++k)
      sum += (box[2 * k + 1] - box[2 * k]) * (box[2 * k + 1] - box[2 * k]);
    return sum;
  }
};

/// If a square exceeds another square by this fraction, its rounded root is certainly larger.
inline constexpr double kBeyondTies = 1e-12;

/// Points of R^D in a k-d tree. Searches start at the smallest node whose cell contains the ball to
/// be searched. The cell of a node is a region of space in which all points belong to the node.
template <int D>
class PointTree {
 public:
  using S = Squares<D>;
  using Point = std::array<double, D>;

  /// @param points points with D coordinates for which has_plain_coordinates is true.
  /// @param rows the rows of the points to use, no two of which may be equal.
  PointTree(PointsView points, std::span<const std::uint32_t> rows, const RunContext& context)
      : tree_(points, rows, context),
        coordinates_(tree_.points().row(0)),
        cells_(std::size_t{tree_.node_count()} * 2 * D, &context.memory) {
    // Twice the largest possible rounding error of (a + b) / 2 on each axis.
    midpoint_error_ = 2 * std::sqrt(D) * std::numeric_limits<double>::epsilon() *
                      largest_coordinate(tree_.points());
    make_cells();
  }

  std::size_t size() const { return tree_.size(); }
  const double* point(Position p) const { return coordinates_ + std::size_t{p} * D; }
  std::uint32_t row(Position p) const { return tree_.rows()[p]; }
  const double* box(Node node) const { return tree_.box(node); }
  Node node_count() const { return tree_.node_count(); }
  bool is_leaf(Node node) const { return tree_.is_leaf(node); }
  Position begin(Node node) const { return tree_.begin(node); }
  Position end(Node node) const { return tree_.end(node); }
  Node leaf_of(Position p) const {
    const std::uint64_t leaves = tree_.first_leaf();
    return static_cast<Node>(leaves + ((p + 1) * leaves - 1) / size());
  }
  double square(Position p, Position q) const { return S::between(point(p), point(q)); }

  /// An upper bound for the distance between a computed midpoint and the true midpoint.
  double midpoint_error() const { return midpoint_error_; }
  static Point midpoint(const double* a, const double* b) {
    Point m;
    for (int k = 0; k < D; ++k) m[static_cast<std::size_t>(k)] = 0.5 * (a[k] + b[k]);
    return m;
  }
  Point centre(Node node) const {
    Point m;
    const double* b = box(node);
    for (int k = 0; k < D; ++k) m[static_cast<std::size_t>(k)] = 0.5 * (b[2 * k] + b[2 * k + 1]);
    return m;
  }
  /// All points of a node are within this distance of the computed centre.
  double radius(Node node) const {
    return 0.5 * std::sqrt(S::extent(box(node))) * (1 + kBeyondTies) + midpoint_error_;
  }

  /// The lowest node that contains all points of a ball. The search starts at `node` and goes up.
  Node holder_of_ball(Node node, const Point& centre, double radius) const {
    for (radius *= 1 + kBeyondTies; node > 1; node /= 2) {
      const double* cell = &cells_[std::size_t{node} * 2 * D];
      bool holds = true;
      for (int k = 0; k < D; ++k) {
        const double x = centre[static_cast<std::size_t>(k)];
        holds = holds && x - cell[2 * k] > radius && cell[2 * k + 1] - x > radius;
      }
      if (holds) break;
    }
    return node;
  }

  /// Calls `visit(position)` for the points below `start` until `visit` returns true. Skips nodes
  /// for which `is_hopeless(box, node)` is true. @return true if a visit returned true.
  template <class IsHopeless, class Visit>
  bool search(Node start, IsHopeless&& is_hopeless, Visit&& visit) const {
    std::array<Node, 64> stack;
    std::size_t height = 0;
    for (Node node = start;;) {
      if (!is_hopeless(box(node), node)) {
        if (!is_leaf(node)) {
          stack[height++] = 2 * node + 1;
          node = 2 * node;
          continue;
        }
        const Position last = end(node);
        for (Position p = begin(node); p < last; ++p)
          if (visit(p)) return true;
      }
      if (height == 0) return false;
      node = stack[--height];
    }
  }

  /// Searches the points below `start` that satisfy `is_allowed` and whose squared distance from x
  /// is below `limit`. @return the nearest of these points, or the first of them whose squared
  /// distance is below `near_enough`. Returns kNone if there is no such point.
  template <class IsAllowed>
  Position nearest(Node start, const Point& x, double limit, double near_enough,
                   IsAllowed&& is_allowed) const {
    struct Entry {
      double square;
      Node node;
    };
    std::array<Entry, 64> stack;
    std::size_t height = 0;
    Position best = kNone;
    for (Entry at{S::least(x.data(), box(start)), start};;) {
      if (at.square < limit) {
        if (!is_leaf(at.node)) {
          Entry near{S::least(x.data(), box(2 * at.node)), 2 * at.node};
          Entry far{S::least(x.data(), box(2 * at.node + 1)), 2 * at.node + 1};
          if (far.square < near.square) std::swap(near, far);
          stack[height++] = far;
          at = near;
          continue;
        }
        const Position last = end(at.node);
        for (Position p = begin(at.node); p < last; ++p) {
          const double square = S::between(x.data(), point(p));
          if (square >= limit || !is_allowed(p)) continue;
          limit = square;
          best = p;
        }
        if (limit < near_enough) return best;
      }
      if (height == 0) return best;
      at = stack[--height];
    }
  }
  Position nearest(Node start, const Point& x, double limit) const {
    return nearest(start, x, limit, 0, [](Position) { return true; });
  }

 private:
  void make_cells() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int k = 0; k < D; ++k) {
      cells_[static_cast<std::size_t>(2 * D + 2 * k)] = -infinity;
      cells_[static_cast<std::size_t>(2 * D + 2 * k + 1)] = infinity;
    }
    for (Node node = 1; node < tree_.first_leaf(); ++node) {
      double *cell = &cells_[std::size_t{node} * 2 * D], *left = cell + std::size_t{node} * 2 * D,
             *right = left + 2 * D;
      std::copy_n(cell, 2 * D, left);
      std::copy_n(cell, 2 * D, right);
      const double *below = box(2 * node), *above = box(2 * node + 1);
      // The cell of a child extends to the first point of the other child.
      for (int k = 0; k < D; ++k) {
        if (below[2 * k + 1] > above[2 * k]) continue;
        left[2 * k + 1] = above[2 * k];  // mutant: beta-cell-end
        right[2 * k] = below[2 * k + 1];
        break;
      }
    }
  }

  KdTree tree_;
  const double* coordinates_;
  std::pmr::vector<double> cells_;  // cell of each node, stored like a box
  double midpoint_error_ = 0;
};

}  // namespace ph::beta_skeleton
