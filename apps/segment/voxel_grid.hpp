// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// The occupied voxels of a grid whose corner is the origin, in the order of their coordinates
/// (z slowest).
struct VoxelGrid {
  std::vector<Vec3> cells;              ///< of each voxel: whole numbers, its corner / voxel
  Points centroids;                     ///< mean of the points of each voxel, one a row, metres
  std::vector<Index> counts;            ///< points of each voxel
  std::vector<std::uint32_t> voxel_of;  ///< the voxel of each point that was put in, in their order
};

/// Puts points into cubes with edge `voxel`. O(points + voxels log voxels). The result depends on
/// the set of points alone, to the last bit: offsets inside a voxel are added as integers.
/// @param points indices into the cloud, none of them a hole. @param voxel metres, > 0.
/// @throws Error (usage) if `voxel` is too small for coordinates of this size.
VoxelGrid voxel_grid(const CloudView& cloud, const std::vector<Index>& points, double voxel);

}  // namespace ph::segment
