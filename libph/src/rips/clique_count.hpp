// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The number of cells of each dimension in a flag complex.
struct CliqueCounts {
  std::vector<double> counts;  ///< number of cells of each dimension, without trailing zeros
  /// In dimensions below this number, cells were counted. In the other dimensions, `counts` has
  /// estimates.
  int counted_dims = 0;
};

/// Counts the cliques of up to top + 1 vertices. If there are few cliques, they are counted one by
/// one. Otherwise their number is estimated from a sample. Takes 8 bytes per edge and a fraction of
/// a second.
/// @throws Error (cancelled) on a stop request; Error (resource) beyond the memory limit.
CliqueCounts count_cliques(const RipsGraph& graph, int top, const RunContext& context);

}  // namespace ph
