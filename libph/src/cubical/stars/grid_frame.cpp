// SPDX-License-Identifier: MIT
#include "cubical/stars/grid_frame.hpp"

namespace ph::cubical {
namespace {

constexpr double kMostNodes = 2'147'000'000;  // ids of nodes and labels have 31 bits

bool keeps_axis(const CubicalImage& grid, std::size_t k) {
  return grid.extents[k] > 1 || (!grid.voxels_are_vertices && !grid.periodic[k]);
}

}  // namespace

bool GridFrame::can_hold(const CubicalImage& grid) {
  int axes = 0;
  double nodes = 1;  // of the larger one of the two graphs, but for the outside
  for (std::size_t k = 0; k < grid.extents.size(); ++k) {
    if (!keeps_axis(grid, k)) continue;
    ++axes;
    nodes *= static_cast<double>(grid.extents[k]) + (grid.voxels_are_vertices ? 0 : 1);
  }
  // Labels are those of the outside, of what never enters and of the roots, fewer than nodes.
  return axes <= 3 && grid.size() > 0 && nodes < kMostNodes;
}

GridFrame::GridFrame(const CubicalImage& grid)
    : grid_(grid),
      size_(static_cast<std::uint32_t>(grid.size())),
      is_t_construction_(!grid.voxels_are_vertices) {
  int axis = 3;
  std::uint32_t stride = 1;
  for (std::size_t k = grid.extents.size(); k-- > 0;) {
    if (!keeps_axis(grid, k)) {
      if (grid.periodic[k]) loops_.push_back(k);
      continue;
    }
    const auto extent = static_cast<std::uint32_t>(grid.extents[k]);
    axes_[--axis] = {extent, stride, true, grid.periodic[k], Divisor(extent), Divisor(stride)};
    input_axis_[axis] = static_cast<int>(k);
    stride *= extent;
    ++top_dim_;
    axes_[axis].has_ends = !grid.periodic[k];
    if (!grid.periodic[k]) continue;
    any_periodic_ = true;
    axes_[axis].wrapped = 0;
  }
}

void GridFrame::be_part_of_ring(std::uint32_t wrapped) {
  any_periodic_ = true;
  axes_[layer_axis()].wrapped = wrapped;
  axes_[layer_axis()].has_ends = false;
}

void GridFrame::append_numbers(const StarCell& cell, unsigned loops,
                               std::vector<Index>& numbers) const {
  const std::size_t base = numbers.size();
  numbers.resize(base + grid_.extents.size(), 0);
  for (int a = 0; a < 3; ++a) {
    if (!axes_[a].exists) continue;
    const Index n = axes_[a].extent;
    Index x = 2 * Index{coordinate(cell.voxel, a)} + cell.direction[a];
    if (x < 0 && axes_[a].periodic) x = 2 * n - 1;
    numbers[base + static_cast<std::size_t>(input_axis_[a])] =
        is_t_construction_ ? 2 * n - 1 - x : x;
  }
  for (std::size_t i = 0; i < loops_.size(); ++i)
    numbers[base + loops_[i]] = static_cast<Index>(loops >> i & 1U);
}

CubicalImage GridFrame::layers(std::uint32_t begin, std::uint32_t end) const {
  const std::size_t first = is_t_construction_ ? extent(layer_axis()) - end : begin;
  return layers_of(
      static_cast<const std::byte*>(grid_.voxels) + first * layer_size() * bytes_of(grid_.type),
      end - begin);
}

CubicalImage GridFrame::layers_of(const void* voxels, std::uint32_t count) const {
  const auto axis = static_cast<std::size_t>(input_axis_[layer_axis()]);
  CubicalImage image = grid_;
  image.extents[axis] = count;
  image.periodic[axis] = false;
  image.voxels = voxels;
  return image;
}

}  // namespace ph::cubical
