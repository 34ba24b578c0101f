// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include "metric/kd_tree.hpp"
#include "ph/detail/metric/metric.hpp"

namespace ph {

/// Exact searches in a k-d tree: for nearest points, and for all pairs within a distance. Distances
/// are those of PointMetric to the last bit; among points at one distance the one of the smaller
/// row is nearer.
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
    std::span<const std::uint32_t> of_point;  ///< by position
    std::span<const std::uint32_t> of_node;   ///< by node: the part of all its points, or kMixed
  };

  virtual ~NeighbourSearch() = default;

  /// Which of points at one distance are found: those of the smaller rows, or any. Any is much
  /// faster where many points are equal, all at distance 0.
  enum class Ties { by_row, any };

  /// For each point of a leaf its k nearest others at distance <= limit, the nearest first.
  /// @param found k a point, point by point; what is not there is left as kNone.
  virtual void nearest(Node leaf, std::size_t k, double limit, Ties ties,
                       std::span<Neighbour> found) const = 0;
  /// The nearest point of another part at distance <= limit; kNone if there is none.
  virtual Neighbour nearest_foreign(Position p, const Parts& parts, double limit,
                                    Ties ties) const = 0;
  using VisitPair = std::function<void(Index, Index, double)>;
  /// Calls `visit(i, j, distance)` once for each pair of rows i < j at distance <= limit, in an
  /// order that depends on the points alone.
  virtual void pairs_within(double limit, const VisitPair& visit,
                            const RunContext& context) const = 0;

  /// Whether a k-d tree helps to bound the distance.
  static bool can_search(PointDistance distance) {
    return distance == PointDistance::euclidean || distance == PointDistance::manhattan ||
           distance == PointDistance::chebyshev || distance == PointDistance::minkowski;
  }
  /// @param tree outlives the search, as does `metric`, which is that of tree.points().
  /// @param distance one that can be searched. @param p exponent of `minkowski`.
  static std::unique_ptr<NeighbourSearch> make(const KdTree& tree, const PointMetric& metric,
                                               PointDistance distance, double p);
};

}  // namespace ph
