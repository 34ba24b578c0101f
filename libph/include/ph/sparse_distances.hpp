// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <vector>

#include "ph/points.hpp"

namespace ph {

/// A pair of points with its distance.
struct WeightedEdge {
  Index u = 0;
  Index v = 0;
  double value = 0;
  friend bool operator==(const WeightedEdge&, const WeightedEdge&) = default;
};

/// Some of the distances of a finite set; all other pairs are never joined. The distances never
/// change, and copies share them.
class SparseDistances {
 public:
  /// @param size number of points. @param edges pairs u != v below `size`, each pair at most once,
  /// distances >= 0. @throws Error (bad_data) naming the edge that breaks these rules.
  SparseDistances(Index size, std::vector<WeightedEdge> edges);

  /// All pairs of points at Euclidean distance <= radius: O(n log n + edges).
  /// @param points one point per row. @param radius in units of the coordinates, >= 0.
  /// @throws Error (usage) on a radius that is negative or NaN; Error (bad_data) on a coordinate
  ///        that is not finite.
  static SparseDistances within(PointsView points, double radius);

  Index size() const { return size_; }
  const std::vector<WeightedEdge>& edges() const { return *edges_; }

 private:
  Index size_;
  std::shared_ptr<const std::vector<WeightedEdge>> edges_;
};

}  // namespace ph
