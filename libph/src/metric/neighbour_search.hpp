// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/metric/first_edges.hpp"
#include "ph/detail/metric/kd_tree.hpp"
#include "ph/detail/metric/metric.hpp"

namespace ph {

/// The values at which the points of a tree enter, and the least value in each node.
class PointBirths {
 public:
  using Position = KdTree::Position;
  using Node = KdTree::Node;
  /// @param births one per row of the points of which the tree was made, finite, >= 0.
  PointBirths(const KdTree& tree, std::span<const double> births, const RunContext& context);

  double of_point(Position p) const { return of_point_[p]; }
  double least_birth(Node node) const { return of_node_[node].birth; }
  std::uint32_t least_row(Node node) const { return of_node_[node].row; }

 private:
  struct Least {
    double birth = std::numeric_limits<double>::infinity();
    std::uint32_t row = UINT32_MAX;
    void add(const Least& o) {
      birth = std::min(birth, o.birth);
      row = std::min(row, o.row);
    }
  };
  std::pmr::vector<double> of_point_;
  std::pmr::vector<Least> of_node_;
};

/// Exact searches in a k-d tree for nearest points and for all pairs within a given distance.
/// Distances equal the distances of PointMetric to the last bit. If two points are at the same
/// distance, the point with the smaller row number counts as nearer.
///
/// If the points have births, the distance of two points is the value of their edge: the largest of
/// their distance and their births. If the births are core distances, this is the mutual
/// reachability distance (Campello, Moulavi, Sander 2013).
class NeighbourSearch {
 public:
  using Position = KdTree::Position;
  using Node = KdTree::Node;
  static constexpr Position kNone = UINT32_MAX;

  struct Neighbour {
    double distance = std::numeric_limits<double>::infinity();
    Position position = kNone;
  };
  /// A partition of the points.
  struct Parts {
    static constexpr std::uint32_t kMixed = UINT32_MAX;
    std::span<const std::uint32_t> of_point;  ///< part of each position
    /// For each node, the part that contains all its points, or kMixed.
    std::span<const std::uint32_t> of_node;

    /// Finds `of_node` from `of_point`. @param of_node one entry per node of the tree.
    static void find_nodes(const KdTree& tree, std::span<const std::uint32_t> of_point,
                           std::span<std::uint32_t> of_node);
  };

  virtual ~NeighbourSearch() = default;

  /// Decides which of several points at the same distance are found. With `by_row`, they are the
  /// points with the smallest row numbers. With `any`, they are any of these points. This is much
  /// faster if many points are equal and therefore at distance 0.
  enum class Ties { by_row, any };

  /// A request for the nearest points of the points of a leaf.
  struct Query {
    Node leaf = 0;
    std::size_t k = 1;  ///< number of neighbours for each point
    /// For each point of the leaf, the largest distance of a neighbour. A negative number: the
    /// point asks for none.
    std::array<double, KdTree::kLeafSize> limits = {};
    Ties ties = Ties::by_row;
    const Parts* parts = nullptr;  ///< if given, only points of other parts are neighbours
  };
  /// @param found k entries per point of the leaf, point by point, nearest first; entries without a
  /// neighbour have kNone.
  virtual void nearest(const Query& query, std::span<Neighbour> found) const = 0;

  /// Finds the first edge between each pair of parts, which are 0, 1, … O(n²) time, in which boxes
  /// rule out pairs of nodes.
  virtual void first_between_parts(const Parts& parts, FirstEdges& first,
                                   const RunContext& context) const = 0;
  virtual double distance(Position p, Position q) const = 0;
  using VisitPair = std::function<void(Index, Index, double)>;
  /// Calls `visit(i, j, distance)` once for each pair of rows i < j at distance <= limit, in an
  /// order that depends only on the points.
  virtual void pairs_within(double limit, const VisitPair& visit,
                            const RunContext& context) const = 0;

  /// True if a k-d tree can give lower bounds for the distance.
  static bool can_search(PointDistance distance) {
    return distance == PointDistance::euclidean || distance == PointDistance::manhattan ||
           distance == PointDistance::chebyshev || distance == PointDistance::minkowski;
  }
  /// @param tree must outlive the search. @param metric must be the metric of tree.points(), and
  /// must outlive the search.
  /// @param distance a distance that can be searched. @param p exponent of `minkowski`.
  /// @param births null if the points have none; must outlive the search.
  static std::unique_ptr<NeighbourSearch> make(const KdTree& tree, const PointMetric& metric,
                                               PointDistance distance, double p,
                                               const PointBirths* births,
                                               const RunContext& context);
};

}  // namespace ph
