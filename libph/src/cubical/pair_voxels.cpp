// SPDX-License-Identifier: MIT
#include "ph/cubical/pair_voxels.hpp"

#include <mutex>

#include "loop_reduction.hpp"
#include "ph/core/parallel.hpp"
#include "two_graphs.hpp"

namespace ph::cubical {

bool can_pair_voxels(const CubicalImage& grid) { return StarGrid::can_hold(grid); }

namespace {

template <Field K>
void pair_all_of_three_axes(StarGrid& grid, const K& field, const RunContext& context,
                            const BarSink& sink, PairSink& pairs) {
  CriticalCells edges(&context.memory), squares(&context.memory);
  for_each_piece("critical cells", 2, 1, context, [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i)
      i == 0 ? edges = critical_cells(grid, 1, context)
             : squares = critical_cells(grid, 2, context);
  });
  PairSink top_pairs(grid, pairs.wants_cells(), sink);
  pair_in_both_graphs(grid, edges, squares, context, pairs, top_pairs);
  top_pairs.finish();
  mark_paired(grid, edges);
  LoopReduction<K>(grid, squares, field, context, pairs).run();
}

}  // namespace

template <Field K>
void pair_voxels(const CubicalImage& voxels, const K& field, int max_dim, bool wants_cells,
                 const RunContext& context, const BarSink& bars) {
  // Two threads may have some at a time.
  std::mutex mutex;
  const BarSink sink{
      [&](const Bar& bar, std::span<const Index> birth, std::span<const Index> death) {
        const std::lock_guard lock(mutex);
        bars.add(bar, birth, death);
      },
      [&](std::span<const Bar> some) {
        const std::lock_guard lock(mutex);
        bars.add_all(some);
      },
      [&](std::size_t count) {
        const std::lock_guard lock(mutex);
        bars.expect(count);
      }};
  StarGrid grid(voxels, context);
  const int top = grid.top_dim();
  const bool turned_around = grid.relative(), only_components = max_dim == 0;
  PairSink pairs(grid, wants_cells, sink);
  if (top == 3 && !only_components) {
    pair_all_of_three_axes(grid, field, context, sink, pairs);
  } else if (top == 3) {
    // Components come from one graph, the highest dimension from the other; turned around they have
    // changed places.
    CriticalCells cells = critical_cells(grid, turned_around ? 2 : 1, context);
    if (turned_around)
      pair_facets_with_top_cells(grid, cells, context, pairs);
    else
      pair_vertices_with_edges(grid, cells, context, pairs);
  } else {
    CriticalCells edges = critical_cells(grid, 1, context);
    if (top < 2 || !turned_around || !only_components)
      pair_vertices_with_edges(grid, edges, context, pairs);
    if (top == 2 && (turned_around || !only_components))
      pair_facets_with_top_cells(grid, edges, context, pairs);
    // What neither graph takes lives for ever: loops around periodic axes.
    if (top < 2 || !only_components)
      for (const auto& [value, cell] : edges.order)
        pairs.essential(1, {edges.cells[cell].voxel, kEdges[edges.cells[cell].number], value});
  }
  pairs.finish();
}

template void pair_voxels(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                          const BarSink&);
template void pair_voxels(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                          const BarSink&);

}  // namespace ph::cubical
