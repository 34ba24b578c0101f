// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"
#include "ph/detail/cubical/bar_sink.hpp"

namespace ph::cubical {

/// The lowest dimension of pairs that can give a wanted bar: periodic axes of one voxel raise
/// dimensions.
inline int lowest_dim(const GridShape& grid, const BarRequest& wanted) {
  return wanted.min_dim - static_cast<int>(grid.loop_count());
}
/// True if bars of three or more axes are wanted that come from neither graph.
inline bool wants_loops(const GridShape& grid, const BarRequest& wanted) {
  // Around periodic axes, classes of all dimensions may live forever.
  return grid.top_dim() >= 3 && wanted.max_dim > 0 &&
         (lowest_dim(grid, wanted) <= grid.top_dim() - 2 || grid.any_periodic());
}
/// True if bars are wanted from the graph that gives H0; except for three axes, this holds for any
/// bars.
inline bool wants_lowest(const GridShape& grid, const BarRequest& wanted) {
  return lowest_dim(grid, wanted) <= 0 || grid.top_dim() < 3;
}
/// True if bars are wanted from the graph of voxels: H0, or the highest dimension if the image is
/// reversed. For one axis it gives all bars.
inline bool wants_vertices(const GridShape& grid, const BarRequest& wanted) {
  if (grid.top_dim() < 2) return true;
  return grid.is_t_construction() ? wanted.max_dim > 0 : wants_lowest(grid, wanted);
}
/// The same for the graph of top cells.
inline bool wants_top_cells(const GridShape& grid, const BarRequest& wanted) {
  if (grid.top_dim() < 2) return false;
  return grid.is_t_construction() ? wants_lowest(grid, wanted) : wanted.max_dim > 0;
}

/// Number of tasks, out of two, per thread: both if a second thread would cost more than it saves.
inline std::size_t tasks_at_a_time(const GridFrame& frame) {
  constexpr std::uint32_t few = 1 << 16;  // voxels
  return frame.size() < few ? 2 : 1;
}

/// Components of the sublevel sets: voxels joined by edges, in the order of the stars. Removes the
/// edges that kill from the order of `edges`, which holds all critical ones.
void pair_vertices_with_edges(const StarGrid& grid, CriticalCells& edges, const RunContext& context,
                              PairSink& sink);

/// The same on the dual graph, backwards: top cells joined by their facets, youngest first; cells
/// that never enter and the outside were always there. Removes the facets that give birth from the
/// order of `facets`, which holds all critical ones that kill nothing. Precondition: grid.top_dim()
/// >= 2.
void pair_facets_with_top_cells(const StarGrid& grid, CriticalCells& facets,
                                const RunContext& context, PairSink& sink);

/// Both of them for three axes, in parallel if there are threads. @param top_sink receives the
/// second.
void pair_in_both_graphs(const StarGrid& grid, CriticalCells& edges, CriticalCells& squares,
                         const RunContext& context, PairSink& sink, PairSink& top_sink);

}  // namespace ph::cubical
