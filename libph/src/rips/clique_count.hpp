// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// How many cells of each dimension a flag complex has.
struct CliqueCounts {
  std::vector<double> counts;  ///< by dimension; trailing zeros are left out
  int counted_dims = 0;        ///< the dimensions below are counted, the others estimated
};

/// Counts the cliques of up to top + 1 vertices: one by one where there are few, else by a sample.
/// Takes 8 bytes an edge and a small part of a second.
/// @throws Error (cancelled) on a stop request; Error (resource) beyond the memory limit.
CliqueCounts count_cliques(const RipsGraph& graph, int top, const RunContext& context);

}  // namespace ph
