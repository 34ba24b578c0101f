// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "ph/detail/core/radix_sort.hpp"

namespace ph::alpha {

/// A critical simplex, with its value and its number. The meaning of the number depends on the list
/// that contains the simplex.
struct Ranked {
  double value;
  std::uint32_t number;
  std::uint32_t code = kNone;  ///< the name of the simplex if it is a facet
};
using RankedSimplices = std::pmr::vector<Ranked>;

/// The critical facets from old to young. Their numbers are positions in AlphaCells::facets.
inline RankedSimplices ranked_facets(const AlphaCells& cells, const RunContext& context) {
  RankedSimplices ranked(cells.facets.size(), &context.memory);
  for (std::uint32_t i = 0; i < ranked.size(); ++i)
    ranked[i] = {cells.facets[i].value, i, cells.facets[i].code};
  radix_sort_by_value(
      ranked, [](const Ranked& r) { return r.value; }, context);
  return ranked;
}

/// The critical edges from old to young. In dimension 3, their numbers are numbers of edges. In
/// dimension 2, they are positions in AlphaCells::facets. In dimension 1, they are numbers of
/// cells.
inline RankedSimplices ranked_edges(const AlphaCells& cells, const RunContext& context) {
  if (cells.dim() == 2) return ranked_facets(cells, context);
  RankedSimplices ranked(&context.memory);
  if (cells.dim() == 3) {
    std::size_t count = 0;
    for (const Edge& edge : cells.edge_states) count += edge.up == kCritical ? 1 : 0;
    ranked.reserve(count);
    for (std::uint32_t e = 0; e < cells.edge_states.size(); ++e)
      if (cells.edge_states[e].up == kCritical) ranked.push_back({cells.edge_states[e].value, e});
  } else if (cells.dim() == 1) {
    for (std::uint32_t t = 0; t < cells.triangulation.size(); ++t)
      if (cells.beyond[t] == 0) ranked.push_back({cells.cell_values[t], t});
  }
  radix_sort_by_value(
      ranked, [](const Ranked& r) { return r.value; }, context);
  return ranked;
}

/// The ends of an edge.
inline std::array<std::uint32_t, 2> ends_of(const AlphaCells& cells, const Ranked& edge) {
  if (cells.dim() == 3) return cells.edges.ends[edge.number];
  if (cells.dim() == 2) {
    const auto ends = cells.facet_vertices(edge.code);
    return {ends[0], ends[1]};
  }
  return {cells.triangulation.cells[edge.number][0], cells.triangulation.cells[edge.number][1]};
}
/// Prefetches the data that `ends_of` reads. Should be called some time before `ends_of`.
inline void prefetch_ends(const AlphaCells& cells, const Ranked& edge) {
  if (cells.dim() == 3)
    __builtin_prefetch(&cells.edges.ends[edge.number]);
  else
    __builtin_prefetch(&cells.triangulation.cells[cells.dim() == 2 ? edge.code >> 2 : edge.number]);
}

/// A set of simplices, as one bit per number.
using SimplexSet = std::pmr::vector<bool>;

}  // namespace ph::alpha
