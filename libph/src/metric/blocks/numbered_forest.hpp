// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The minimum spanning forest of some edges between points of a cloud, and claims that must be
/// true for the forest of the entire cloud. Two of these objects can be joined. The result is the
/// minimum spanning forest of the edges of both objects. It is the same, byte for byte, for any
/// order of joins.
struct NumberedForest {
  explicit NumberedForest(const RunContext& context)
      : numbers(&context.memory), edges(&context.memory), claims(&context.memory) {}

  /// The numbers of the points that occur in edges or claims, ascending. Edges and claims refer to
  /// points by their positions in this list.
  std::pmr::vector<Index> numbers;
  FlagEdges edges;  ///< sorted
  /// The claims, in sorted order. A claim says that its ends are joined by edges no longer than its
  /// value. A claim is left out if `edges` already fulfil it.
  FlagEdges claims;

  /// Joins another forest into this one. @param context counts the memory that is needed during the
  /// call.
  /// @throws Error (resource) if the two forests together have 2^32 - 1 points or more.
  void join(NumberedForest other, const RunContext& context);
  /// Keeps the edges that Kruskal's algorithm selects, and the claims that these edges do not
  /// fulfil.
  void reduce(const RunContext& context);
};

/// Sorts by (value, u, v), the order of a filtration.
void sort_edges(FlagEdges& edges, const RunContext& context);

}  // namespace ph
