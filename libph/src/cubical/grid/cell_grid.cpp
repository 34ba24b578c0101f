// SPDX-License-Identifier: MIT
#include "libph/src/cubical/grid/cell_grid.hpp"

#include <algorithm>
#include <span>

#include "ph/detail/core/radix_sort.hpp"

namespace ph::cubical {
namespace {

// False for an axis along which the image is a single vertex, or a circle of one voxel.
bool keeps_axis(const CubicalImage& grid, std::size_t k) {
  return grid.extents[k] > 1 || (!grid.voxels_are_vertices && !grid.periodic[k]);
}

std::uint32_t doubled(const CubicalImage& grid, std::size_t k) {
  const auto n = static_cast<std::uint32_t>(grid.extents[k]);
  return grid.periodic[k] ? 2 * n : grid.voxels_are_vertices ? 2 * n - 1 : 2 * n + 1;
}

}  // namespace

double CellGrid::count_cells(const CubicalImage& grid) {
  double cells = 1;
  for (std::size_t k = 0; k < grid.extents.size(); ++k)
    if (keeps_axis(grid, k)) cells *= static_cast<double>(doubled(grid, k));
  return cells;
}

bool CellGrid::can_hold(const CubicalImage& grid) {
  int axes = 0;
  for (std::size_t k = 0; k < grid.extents.size(); ++k) axes += keeps_axis(grid, k) ? 1 : 0;
  return axes <= kMostAxes && grid.size() > 0 && count_cells(grid) < static_cast<double>(kNone);
}

CellGrid::CellGrid(const CubicalImage& grid, const RunContext& context)
    : grid_(grid), ranks_(&context.memory), order_(&context.memory), marks_(&context.memory) {
  for (std::size_t k = 0; k < grid.extents.size(); ++k) {
    if (!keeps_axis(grid, k)) {
      if (grid.periodic[k]) loops_.push_back(k);
      continue;
    }
    const auto i = static_cast<std::size_t>(dim_++);
    axes_[i] = {static_cast<std::uint32_t>(grid.extents[k]), doubled(grid, k), 1, grid.periodic[k],
                Divisor(doubled(grid, k))};
    input_axis_[i] = k;
  }
  std::uint32_t cells = 1;
  for (auto k = static_cast<std::size_t>(dim_); k-- > 0;) {
    axes_[k].stride = cells;
    cells *= axes_[k].length;
  }
  rank_voxels(context);
  marks_.resize(cells);
}

void CellGrid::rank_voxels(const RunContext& context) {
  const std::size_t size = grid_.size();
  Ticker ticker(context, "voxels", size);
  order_.reserve(size);
  for (std::size_t v = 0; v < size; ++v) {
    if (grid_.value(v) <= grid_.limit) order_.push_back(static_cast<std::uint32_t>(v));
    ticker.tick();
  }
  // The values of voxels are looked up in the image, which saves a third array.
  ranks_.resize(size);
  const std::span<std::uint32_t> sorted = radix_sort_by_value(
      std::span(order_), std::span(ranks_).first(order_.size()),
      [&](std::uint32_t v) {
        ticker.work();
        return grid_.value(v);
      },
      context);
  if (sorted.data() == ranks_.data()) std::ranges::copy(sorted, order_.begin());
  std::ranges::fill(ranks_, kNone);
  for (std::uint32_t rank = 0; rank < order_.size(); ++rank) {
    ranks_[order_[rank]] = rank;
    ticker.work();
  }
}

void CellGrid::append_numbers(std::uint32_t cell, unsigned loops,
                              std::vector<Index>& numbers) const {
  const std::size_t base = numbers.size();
  numbers.resize(base + grid_.extents.size(), 0);
  const Coordinates x = coordinates(cell);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k)
    numbers[base + input_axis_[k]] = Index{x[k]};
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    // Along a periodic axis with one voxel, the doubled grid is a circle of one vertex (coordinate
    // 0) and one edge (coordinate 1). The voxel is the vertex in the V-construction, and the edge
    // in the T-construction. If bit i of `loops` is set, the copy of the cell goes around the
    // circle.
    numbers[base + loops_[i]] = static_cast<Index>(loops >> i & 1U);
  }
}

}  // namespace ph::cubical
