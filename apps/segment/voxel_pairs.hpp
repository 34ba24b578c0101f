// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "voxel_grid.hpp"

namespace ph::segment {

/// Two voxels near each other.
struct VoxelPair {
  std::uint32_t u, v;  ///< u < v
  float distance;      ///< of their centroids, metres
};

using VoxelPairs = std::pmr::vector<VoxelPair>;

/// All pairs of voxels whose centroids are closer than a number of voxels, in an order that depends
/// on the voxels alone. O(rows * reach^2 + pairs): no tree, no hash.
/// @param voxel edge of a voxel of the grid, metres. @param reach in voxels, > 0; small, for it is
/// counted through. @throws Error (usage) as require_exact_cells.
VoxelPairs close_voxels(const VoxelGrid& grid, double voxel, double reach,
                        std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace ph::segment
