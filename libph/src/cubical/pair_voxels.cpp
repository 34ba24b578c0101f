// SPDX-License-Identifier: MIT
#include "ph/detail/cubical/pair_voxels.hpp"

#include <algorithm>
#include <bit>
#include <mutex>
#include <string>

#include "libph/src/cubical/any_axes/pair_cells.hpp"
#include "libph/src/cubical/graphs/two_graphs.hpp"
#include "libph/src/cubical/loops/loop_reduction.hpp"
#include "libph/src/cubical/slabs/pair_in_slabs.hpp"
#include "libph/src/image/voxels_in_use.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"

namespace ph::cubical {

namespace {

// For each voxel, either a star and a node of a graph are stored, or two ranks. Each of these four
// numbers takes 4 bytes.
constexpr double kBytesOfVoxel = 8;

bool has_few_axes(const CubicalImage& grid) { return GridShape::count_axes(grid) <= 3; }

/// True if the image can be cut into slabs and is so large that slabs save memory.
bool may_be_cut(const CubicalImage& grid) {
  constexpr std::size_t few = 1 << 18;  // voxels
  return LayeredImage::can_cut(grid) && grid.size() >= few;
}

}  // namespace

bool can_pair_voxels(const CubicalImage& grid, int max_dim) {
  if (StarGrid::can_hold(grid) || can_pair_cells(grid)) return true;
  // Images with three axes and too many voxels for loops are accepted here, because no other engine
  // can compute their loops either. `pair_voxels` refuses these images if loops are wanted.
  return can_be_cut(grid, {.min_dim = 0, .max_dim = max_dim});
}

bool can_be_cut(const CubicalImage& grid, const BarRequest& wanted) {
  return LayeredImage::can_cut(grid) &&
         (has_few_axes(grid) || !wants_loops(GridShape(grid), wanted));
}

double bytes_to_pair_voxels(const CubicalImage& grid) {
  const double of_voxels = kBytesOfVoxel * static_cast<double>(grid.size());
  if (StarGrid::can_hold(grid)) return of_voxels;
  return can_pair_cells(grid) ? of_voxels + bytes_of_cells(grid) : least_bytes_to_pair_voxels(grid);
}

double least_bytes_to_pair_voxels(const CubicalImage& grid) {
  if (can_pair_cells(grid) && !has_few_axes(grid)) return bytes_to_pair_voxels(grid);
  return may_be_cut(grid) ? kBytesOfVoxel * static_cast<double>(LayeredImage(grid).layer_size())
                          : bytes_to_pair_voxels(grid);
}

bool can_pair_by_layers(const CubicalImage& grid, const BarRequest& wanted) {
  return has_few_axes(grid) && may_be_cut(grid) && !wants_loops(GridShape(grid), wanted);
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

// Computes all bars except the bars of loops in images with three axes.
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
  if (wants_vertices(grid.shape(), wanted)) pair_vertices_with_edges(grid, edges, context, pairs);
  if (wants_top_cells(grid.shape(), wanted))
    pair_facets_with_top_cells(grid, edges, context, pairs);
  // Cells that neither graph pairs give birth to classes that never die: loops around periodic
  // axes.
  if (grid.top_dim() < 2 || wanted.max_dim > 0)
    for (const auto& [value, cell] : edges.order)
      pairs.essential(1,
                      StarCell{edges.cells[cell].voxel, kEdges[edges.cells[cell].number], value});
}

// True if the image can be processed at once within the memory limit. In doubtful cases, some
// layers are processed to find out.
bool fits(const CubicalImage& voxels, const RunContext& context) {
  if (!StarGrid::can_hold(voxels)) return false;
  // The least and the most memory per voxel, and the memory per critical cell, all in bytes.
  constexpr double least = kBytesOfVoxel, most = 168, per_cell = 64;
  const LayeredImage image(voxels);
  const auto size = static_cast<double>(image.size());
  // Pages of a file that have been read also occupy memory.
  const double in_file = voxels.is_in_file ? static_cast<double>(bytes_of(voxels.type)) : 0;
  const double left = static_cast<double>(context.memory.left()) - in_file * size;
  if (most * size < left) return true;
  if (least * size > left) return false;
  constexpr std::uint64_t few = 1 << 12, samples = 8;  // voxels per sample, number of samples
  const std::uint64_t height = std::max(few / image.layer_size(), std::uint64_t{1});
  Slabs slabs(image, height, context);
  const std::uint64_t step = std::max(slabs.count() / samples, std::uint64_t{1});
  double cells = 0, seen = 0;
  for (std::uint64_t slab = step / 2; slab < slabs.count(); slab += step) {
    const StarGrid grid = slabs.stars(slab);
    for (const std::uint32_t v : grid.critical()) {
      const std::uint32_t star = grid.star(v);
      cells += 1 + std::popcount(grid.tables(v).critical_edges(star));
      if (grid.top_dim() == 3)
        cells += std::popcount(grid.tables(v).critical_squares(star, grid.pair_cubes(v)));
    }
    seen += static_cast<double>(height * image.layer_size());
  }
  constexpr double margin = 1.3;  // because other layers may have more critical cells
  return margin * size * (least + per_cell * cells / seen) < left;
}

bool is_cut(const CubicalImage& voxels, const BarRequest& wanted, const RunContext& context) {
  if (!can_be_cut(voxels, wanted)) return false;
  // With four axes or more, slabs give only the bars of the two graphs.
  return !has_few_axes(voxels) || context.slab_layers > 0 ||
         (may_be_cut(voxels) && !fits(voxels, context));
}

template <Field K>
void pair_by_slabs(const CubicalImage& voxels, const K& field, const BarRequest& wanted,
                   const RunContext& context, const BarSink& sink) {
  const LayeredImage image(voxels);
  if (wants_loops(image.shape(), wanted) && !StarGrid::can_hold(voxels))
    throw Error(
        ErrorKind::resource,
        "bars of dimension 1: found " + std::to_string(voxels.size()) +
            " voxels, expected fewer than about 2^31; a larger image is possible for dimension "
            "0 alone (max_dim 0)" +
            (image.shape().any_periodic() ? "" : ", for dimension 2 alone (min_dim 2)") +
            ", and for all dimensions if it is computed in parts");
  PairSink pairs(image.shape(), wanted.cells, sink);
  Slabs slabs(image, Slabs::layers_that_fit(image, context), context);
  pair_in_slabs(slabs, field, wanted, context, pairs);
}

}  // namespace

template <Field K>
void pair_voxels(const CubicalImage& voxels, const K& field, const BarRequest& wanted,
                 const RunContext& context, const BarSink& bars) {
  // Two threads may deliver bars at the same time.
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
  if (is_cut(voxels, wanted, context)) {
    pair_by_slabs(voxels, field, wanted, context, sink);
    return;
  }
  if (!StarGrid::can_hold(voxels)) {
    pair_cells(voxels, field, wanted.max_dim, wanted.cells, context, bars);
    return;
  }
  const VoxelsInUse voxels_are_read(voxels, context);
  StarGrid grid(voxels, context);
  PairSink pairs(grid.shape(), wanted.cells, sink);
  if (wants_loops(grid.shape(), wanted))
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
