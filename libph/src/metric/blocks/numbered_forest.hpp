// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The minimum spanning forest of some edges between points of a cloud, and claims that must hold
/// for the entire cloud's forest. Joining two of them gives the forest of both lists of edges: the
/// bytes are the same for every grouping.
struct NumberedForest {
  explicit NumberedForest(const RunContext& context)
      : numbers(&context.memory), edges(&context.memory), claims(&context.memory) {}

  /// Numbers of the points that occur, ascending; edges and claims use positions in it.
  std::pmr::vector<Index> numbers;
  FlagEdges edges;  ///< sorted
  /// Sorted. A claim says that its ends are joined by edges no longer than its value. Claims that
  /// already hold are left out.
  FlagEdges claims;

  /// Takes in another forest. @param context for the memory needed meanwhile.
  /// @throws Error (resource) if together they have 2^32 - 1 points or more.
  void join(NumberedForest other, const RunContext& context);
  /// Keeps the edges that Kruskal's algorithm takes, and the claims that are still open.
  void reduce(const RunContext& context);
};

/// Sorts by (value, u, v), the order of a filtration.
void sort_edges(FlagEdges& edges, const RunContext& context);

}  // namespace ph
