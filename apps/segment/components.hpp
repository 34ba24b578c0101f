// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/segment.hpp"
#include "voxel_grid.hpp"

namespace ph::segment {

/// The components of infinite persistence that are large enough, and a label for each point.
struct Components {
  std::vector<Segment> segments;      ///< by decreasing number of points; label i + 1
  std::vector<std::uint32_t> labels;  ///< one a point of the cloud
};

/// @param tree of the complex whose vertices are the voxels of the grid.
/// @param points what was put into the grid. @param min_size fewest voxels of a segment.
Components extract_components(const CloudView& cloud, const std::vector<Index>& points,
                              const VoxelGrid& grid, const MergeTree& tree, Index min_size);

}  // namespace ph::segment
