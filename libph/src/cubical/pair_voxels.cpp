// SPDX-License-Identifier: MIT
#include "cubical/pair_voxels.hpp"

#include <algorithm>
#include <bit>
#include <mutex>

#include "cubical/any_axes/pair_cells.hpp"
#include "cubical/graphs/two_graphs.hpp"
#include "cubical/loops/loop_reduction.hpp"
#include "cubical/slabs/pair_in_slabs.hpp"
#include "image/voxels_in_use.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {

bool can_pair_voxels(const CubicalImage& grid) {
  return StarGrid::can_hold(grid) || can_pair_cells(grid);
}

namespace {

constexpr double kBytesOfVoxel = 8;  // a star, and a node of a graph; or ranks

/// Slabs of small images would take as much as they do.
bool may_be_cut(const GridFrame& frame) {
  constexpr std::uint32_t few = 1 << 18;  // voxels
  return Slabs::can_cut(frame) && frame.size() >= few;
}

}  // namespace

double bytes_to_pair_voxels(const CubicalImage& grid) {
  const double of_voxels = kBytesOfVoxel * static_cast<double>(grid.size());
  return StarGrid::can_hold(grid) ? of_voxels : of_voxels + bytes_of_cells(grid);
}

double least_bytes_to_pair_voxels(const CubicalImage& grid) {
  if (!StarGrid::can_hold(grid)) return bytes_to_pair_voxels(grid);
  const GridFrame frame(grid);
  return may_be_cut(frame) ? kBytesOfVoxel * frame.layer_size() : bytes_to_pair_voxels(grid);
}

bool can_pair_by_layers(const CubicalImage& grid, const BarRequest& wanted) {
  if (!StarGrid::can_hold(grid)) return false;
  const GridFrame frame(grid);
  return may_be_cut(frame) && !wants_loops(frame.shape(), wanted);
}

namespace {

template <Field K>
void pair_all_of_three_axes(StarGrid& grid, const K& field, const RunContext& context,
                            const BarSink& sink, PairSink& pairs) {
  CriticalCells edges(&context.memory), squares(&context.memory);
  for_each_piece("critical cells", 2, tasks_at_a_time(grid), context,
                 [&](std::size_t i, std::size_t end) {
                   for (; i < end; ++i)
                     i == 0 ? edges = critical_cells(grid, 1, context)
                            : squares = critical_cells(grid, 2, context);
                 });
  PairSink top_pairs(grid.shape(), pairs.wants_cells(), sink);
  pair_in_both_graphs(grid, edges, squares, context, pairs, top_pairs);
  top_pairs.finish();
  mark_paired(grid, edges);
  const FreeEdges free = free_edges(grid, context);
  LoopReduction<K, StarGrid>(grid, free, squares, field, context).run(pairs);
}

// Bars of all but the loops of three axes.
void pair_by_components(const StarGrid& grid, const BarRequest& wanted, const RunContext& context,
                        PairSink& pairs) {
  if (grid.top_dim() == 3) {
    if (wants_vertices(grid.shape(), wanted)) {
      CriticalCells edges = critical_cells(grid, 1, context);
      pair_vertices_with_edges(grid, edges, context, pairs);
    }
    if (wants_top_cells(grid.shape(), wanted)) {
      CriticalCells squares = critical_cells(grid, 2, context);
      pair_facets_with_top_cells(grid, squares, context, pairs);
    }
    return;
  }
  CriticalCells edges = critical_cells(grid, 1, context);
  if (grid.top_dim() < 2 || wants_vertices(grid.shape(), wanted))
    pair_vertices_with_edges(grid, edges, context, pairs);
  if (grid.top_dim() == 2 && wants_top_cells(grid.shape(), wanted))
    pair_facets_with_top_cells(grid, edges, context, pairs);
  // What neither graph takes lives for ever: loops around periodic axes.
  if (grid.top_dim() < 2 || wanted.max_dim > 0)
    for (const auto& [value, cell] : edges.order)
      pairs.essential(1,
                      StarCell{edges.cells[cell].voxel, kEdges[edges.cells[cell].number], value});
}

// Whether all fits into memory at a time: by what some layers take if that is not clear.
bool fits(const CubicalImage& voxels, const GridFrame& frame, const RunContext& context) {
  constexpr double least = kBytesOfVoxel, most = 168, per_cell = 64;  // a voxel, a critical cell
  // What is read of a file is in memory, too.
  const double in_file = voxels.is_in_file ? static_cast<double>(bytes_of(voxels.type)) : 0;
  const double left = static_cast<double>(context.memory.left()) - in_file * frame.size();
  if (most * frame.size() < left) return true;
  if (least * frame.size() > left) return false;
  Slabs layers(frame, 1, context);
  constexpr std::uint32_t samples = 8;
  const std::uint32_t step = std::max(layers.count() / samples, 1U);
  double cells = 0, seen = 0;
  for (std::uint32_t layer = step / 2; layer < layers.count(); layer += step) {
    const StarGrid grid = layers.stars(layer);
    for (const std::uint32_t v : grid.critical()) {
      const std::uint32_t star = grid.star(v);
      cells += 1 + std::popcount(grid.tables(v).critical_edges(star));
      if (frame.top_dim() == 3)
        cells += std::popcount(grid.tables(v).critical_squares(star, grid.pair_cubes(v)));
    }
    seen += frame.layer_size();
  }
  constexpr double margin = 1.3;  // other layers may have more
  return margin * frame.size() * (least + per_cell * cells / seen) < left;
}

// Whether it has four axes or more, and bars of components are all that is wanted: then no cell
// between those of the two graphs is looked at.
bool has_only_components(const CubicalImage& voxels, const BarRequest& wanted) {
  if (!GridFrame::can_hold(voxels)) return false;
  const GridShape shape(voxels);
  return shape.top_dim() > 3 && !wants_loops(shape, wanted);
}
}  // namespace

template <Field K>
void pair_voxels(const CubicalImage& voxels, const K& field, const BarRequest& wanted,
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
  if (has_only_components(voxels, wanted)) {
    const GridFrame frame(voxels);
    PairSink pairs(frame.shape(), wanted.cells, sink);
    Slabs slabs(frame, Slabs::layers_that_fit(frame, context), context);
    pair_in_slabs(slabs, field, wanted, context, pairs);
    return;
  }
  if (!StarGrid::can_hold(voxels)) {
    pair_cells(voxels, field, wanted.max_dim, wanted.cells, context, bars);
    return;
  }
  const GridFrame frame(voxels);
  PairSink pairs(frame.shape(), wanted.cells, sink);
  if (context.slab_layers > 0 ? Slabs::can_cut(frame)
                              : may_be_cut(frame) && !fits(voxels, frame, context)) {
    Slabs slabs(frame, Slabs::layers_that_fit(frame, context), context);
    pair_in_slabs(slabs, field, wanted, context, pairs);
    return;
  }
  const VoxelsInUse voxels_are_read(voxels, context);
  StarGrid grid(voxels, context);
  if (wants_loops(frame.shape(), wanted))
    pair_all_of_three_axes(grid, field, context, sink, pairs);
  else
    pair_by_components(grid, wanted, context, pairs);
  pairs.finish();
}

template void pair_voxels(const CubicalImage&, const Z2&, const BarRequest&, const RunContext&,
                          const BarSink&);
template void pair_voxels(const CubicalImage&, const Zp&, const BarRequest&, const RunContext&,
                          const BarSink&);

}  // namespace ph::cubical
