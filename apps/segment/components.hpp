// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/segment.hpp"
#include "voxel_grid.hpp"

namespace ph::segment {

/// The components that are large enough, and a label for each point.
struct Components {
  std::vector<Segment> segments;      ///< by decreasing number of points; label i + 1
  std::vector<std::uint32_t> labels;  ///< one a point of the cloud
  std::vector<std::uint32_t> label_of_voxel;
};

/// @param component_of each voxel: one of its voxels, the same for all of the component.
/// @param points what was put into the grid. @param min_size fewest voxels of a segment.
Components extract_components(const CloudView& cloud, const std::vector<Index>& points,
                              const VoxelGrid& grid, const std::vector<Index>& component_of,
                              Index min_size);

/// Gives each segment its neighbour, where they meet, and its persistence.
/// @param tree on the voxels.
void find_neighbours(const MergeTree& tree, Components& components);

}  // namespace ph::segment
