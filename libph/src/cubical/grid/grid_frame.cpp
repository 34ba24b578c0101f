// SPDX-License-Identifier: MIT
#include "libph/src/cubical/grid/grid_frame.hpp"

namespace ph::cubical {
namespace {

constexpr double kMostNodes = 2'147'000'000;  // ids of nodes and labels have 31 bits

}  // namespace

bool GridFrame::can_hold(const CubicalImage& grid) {
  // The number of nodes in the larger of the two graphs, not counting the outside.
  double nodes = 1;
  for (std::size_t k = 0; k < grid.extents.size(); ++k)
    if (GridShape::keeps_axis(grid, k))
      nodes *= static_cast<double>(grid.extents[k]) + (grid.voxels_are_vertices ? 0 : 1);
  // Labels are needed for the outside, for cells that never enter and for roots. Together they are
  // fewer than the nodes.
  return GridShape::count_axes(grid) <= GridShape::kMostAxes && grid.size() > 0 &&
         nodes < kMostNodes;
}

GridFrame::GridFrame(const CubicalImage& grid)
    : grid_(grid),
      size_(static_cast<std::uint32_t>(grid.size())),
      is_t_construction_(!grid.voxels_are_vertices),
      any_periodic_(false),
      shape_(grid) {
  for (int a = 0; a < axis_count(); ++a) {
    const GridShape::Axis& axis = shape_.axis(a);
    if (!axis.exists) continue;
    const auto extent = static_cast<std::uint32_t>(axis.extent);
    const auto stride = static_cast<std::uint32_t>(axis.stride);
    axes_[a] = {extent, stride, true, axis.periodic, Divisor(extent), Divisor(stride)};
    axes_[a].has_ends = !axis.periodic;
    if (!axis.periodic) continue;
    any_periodic_ = true;
    axes_[a].wrapped = 0;
  }
}

void GridFrame::be_part_of_ring(std::uint32_t wrapped) {
  any_periodic_ = true;
  axes_[layer_axis()].wrapped = wrapped;
  axes_[layer_axis()].has_ends = false;
}

}  // namespace ph::cubical
