// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The minimum spanning forest of some edges between points of a cloud, and what has to be true of
/// the whole cloud's. Two of them joined are the one of both lists of edges: whatever the grouping,
/// the same bytes.
struct NumberedForest {
  explicit NumberedForest(const RunContext& context)
      : numbers(&context.memory), edges(&context.memory), claims(&context.memory) {}

  std::pmr::vector<Index> numbers;  ///< of the points that occur, ascending; below: places in it
  FlagEdges edges;                  ///< in order
  /// In order: the ends are joined by edges no longer than that. Those of which that is true
  /// already are left out.
  FlagEdges claims;

  /// Takes in another one. @param context of what is needed meanwhile.
  /// @throws Error (resource) if they have 2^32 - 1 points or more.
  void join(NumberedForest other, const RunContext& context);
  /// Leaves the edges that Kruskal's algorithm takes, and the claims that are still open.
  void reduce(const RunContext& context);
};

/// By (value, u, v), the order of a filtration.
void sort_edges(FlagEdges& edges, const RunContext& context);

}  // namespace ph
