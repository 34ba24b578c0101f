// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"
#include "ph/detail/cubical/bar_sink.hpp"

namespace ph::cubical {

/// The lowest dimension of a pair that can give a wanted bar. A periodic axis with one voxel also
/// gives bars of higher dimensions.
inline int lowest_dim(const GridShape& grid, const BarRequest& wanted) {
  return wanted.min_dim - static_cast<int>(grid.loop_count());
}
/// True if the image has at least three axes and some of the wanted bars come from neither graph.
inline bool wants_loops(const GridShape& grid, const BarRequest& wanted) {
  // With periodic axes, classes of any dimension may live forever.
  return grid.top_dim() >= 3 && wanted.max_dim > 0 &&
         (lowest_dim(grid, wanted) <= grid.top_dim() - 2 || grid.any_periodic());
}
/// True if bars are wanted from the graph that gives H0. With fewer than three axes, the result of
/// this graph is always needed.
inline bool wants_lowest(const GridShape& grid, const BarRequest& wanted) {
  return lowest_dim(grid, wanted) <= 0 || grid.top_dim() < 3;
}
/// True if bars are wanted from the graph of voxels. This graph gives H0 in the V-construction, and
/// the second highest and the highest dimension in the T-construction. With one axis, it gives all
/// bars.
inline bool wants_vertices(const GridShape& grid, const BarRequest& wanted) {
  if (grid.top_dim() < 2) return true;
  return grid.is_t_construction() ? wanted.max_dim > 0 : wants_lowest(grid, wanted);
}
/// True if bars are wanted from the graph of top cells.
inline bool wants_top_cells(const GridShape& grid, const BarRequest& wanted) {
  if (grid.top_dim() < 2) return false;
  return grid.is_t_construction() ? wants_lowest(grid, wanted) : wanted.max_dim > 0;
}

/// The number of tasks, out of two, that a thread takes at once: two if a second thread would cost
/// more time than it saves, otherwise one.
inline std::size_t tasks_at_a_time(const GridFrame& frame) {
  constexpr std::uint32_t few = 1 << 16;  // the number of voxels
  return frame.size() < few ? 2 : 1;
}

/// Pairs voxels with the edges that kill their components, in the order of the stars (GridFrame).
/// Removes these edges from the order of `edges`, which initially lists all critical edges.
void pair_vertices_with_edges(const StarGrid& grid, CriticalCells& edges, const RunContext& context,
                              PairSink& sink);

/// Pairs facets with the top cells that kill them, using the components of the dual graph. In this
/// graph, facets join top cells, youngest first. The outside and the cells that never enter were
/// always there. Removes the paired facets from the order of `facets`, which initially lists all
/// critical facets that kill nothing. Precondition: grid.top_dim() >= 2.
void pair_facets_with_top_cells(const StarGrid& grid, CriticalCells& facets,
                                const RunContext& context, PairSink& sink);

/// Finds the pairs in both graphs of a grid with three axes, in parallel if there are several
/// threads. @param top_sink receives the pairs of facets and top cells.
void pair_in_both_graphs(const StarGrid& grid, CriticalCells& edges, CriticalCells& squares,
                         const RunContext& context, PairSink& sink, PairSink& top_sink);

}  // namespace ph::cubical
