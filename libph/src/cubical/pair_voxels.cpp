// SPDX-License-Identifier: MIT
#include "ph/cubical/pair_voxels.hpp"

#include "loop_reduction.hpp"

namespace ph::cubical {

bool can_pair_voxels(const CubicalImage& grid) { return StarGrid::can_hold(grid); }

template <Field K>
void pair_voxels(const CubicalImage& voxels, const K& field, int max_dim, bool wants_cells,
                 const RunContext& context, const BarSink& sink) {
  StarGrid grid(voxels, context);
  const int top = grid.top_dim();
  const bool turned_around = grid.relative();
  PairSink pairs(grid, wants_cells, sink);
  // Components come from one graph, the highest dimension from the other; turned around they have
  // changed places.
  const bool only_components = max_dim == 0;
  const bool takes_voxels = top < 2 || !turned_around || !only_components;
  CriticalCells edges(&context.memory);
  if (takes_voxels || top == 2) edges = critical_cells(grid, 1, context);
  if (takes_voxels) pair_vertices_with_edges(grid, edges, context, pairs);
  if (top > 1 && (turned_around || !only_components)) {
    CriticalCells squares(&context.memory);
    if (top == 3) squares = critical_cells(grid, 2, context);
    pair_facets_with_top_cells(grid, top == 3 ? squares : edges, context, pairs);
    if (top == 3 && !only_components) LoopReduction<K>(grid, squares, field, context, pairs).run();
  }
  // What neither graph takes lives for ever: loops around periodic axes.
  if (top < 2 || (top == 2 && !only_components))
    for (const auto& [value, cell] : edges.order)
      pairs.essential(1, {edges.cells[cell].voxel, kEdges[edges.cells[cell].number], value});
  pairs.finish();
}

template void pair_voxels(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                          const BarSink&);
template void pair_voxels(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                          const BarSink&);

}  // namespace ph::cubical
