// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/metric/neighbour_search.hpp"

namespace ph {

/// The first neighbours of each point, in the order of their edges.
struct KnownNeighbours {
  using Position = KdTree::Position;
  static constexpr std::size_t kCount = 6;

  std::pmr::vector<Position> positions;  // kCount per point; kNone where fewer are known
  // For each point with fewer than kCount neighbours, the edges to all other points have larger
  // values than this. Empty: these points have no other edges.
  std::pmr::vector<double> others_after;
};

/// @param search a search that has the births of the filtration. @param limit of an edge.
KnownNeighbours known_neighbours(const KdTree& tree, const NeighbourSearch& search, double limit,
                                 const RunContext& context);

/// The nearest points of each point: first the points that decide on its core distance, then as
/// many as KnownNeighbours needs.
class NearestLists {
 public:
  /// @param search a search without births.
  /// @param core receives the distance of each point, by row, to its k-th nearest point.
  NearestLists(const KdTree& tree, const NeighbourSearch& search, std::size_t k,
               std::span<double> core, const RunContext& context);

  /// The first neighbours if points have births: an edge to a point that is not in the list has at
  /// least the length of the list, so the points of the list with smaller values come first.
  /// @param search a search that has the births.
  KnownNeighbours by_value(const NeighbourSearch& search, double limit,
                           const RunContext& context) const;

 private:
  const KdTree& tree_;
  std::size_t length_;
  std::pmr::vector<KdTree::Position> points_;  // length_ per point; kNone where there are fewer
  std::pmr::vector<double> last_;  // the distance of the last point of each list, or infinity
};

}  // namespace ph
