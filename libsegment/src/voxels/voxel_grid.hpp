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

/// Edges of voxels, metres: with these squares of lengths are neither zero nor infinite, and a
/// length of a few voxels is a float.
inline constexpr double kLeastVoxel = 1e-30, kMostVoxel = 1e30;
/// Corners up to here, in voxels, have exact neighbours.
inline constexpr double kMostExactCell = 1ULL << 52;

/// Where neighbours are looked for, the number after a corner must be another one.
/// @throws Error (usage) on a voxel beyond kMostExactCell, naming it.
void require_exact_cells(const VoxelGrid& grid, double voxel);

}  // namespace ph::segment
