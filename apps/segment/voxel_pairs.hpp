// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "voxel_grid.hpp"

namespace ph::segment {

/// Two voxels near each other.
struct VoxelPair {
  std::uint32_t u, v;  ///< u < v
  float distance;      ///< of their centroids, metres
};

/// All pairs of voxels whose centroids are closer than a radius, in an order that depends on the
/// voxels alone. O(rows * (radius / voxel)^2 + pairs): no tree, no hash.
/// @param voxel edge of a voxel of the grid, metres. @param radius metres, > 0.
std::vector<VoxelPair> close_voxels(const VoxelGrid& grid, double voxel, double radius);

}  // namespace ph::segment
