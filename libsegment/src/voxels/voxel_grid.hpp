// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// The occupied voxels of a grid with a corner at the origin, in the order of their coordinates (z
/// slowest).
struct VoxelGrid {
  /// For each voxel, its corner in units of voxels, as whole numbers.
  std::vector<Vec3> cells;
  Points centroids;                     ///< mean of the points of each voxel, one per row, metres
  std::vector<Index> counts;            ///< number of points in each voxel
  std::vector<std::uint32_t> voxel_of;  ///< the voxel of each inserted point, in order of insertion
};

/// Sorts points into cubes with edge `voxel`. Takes O(points + voxels log voxels) time. The result
/// depends only on the set of points, to the last bit, because offsets inside a voxel are added as
/// integers.
/// @param points indices into the cloud, without holes. @param voxel the edge of a cube, in metres,
/// > 0.
/// @throws Error (usage) if `voxel` is too small for coordinates of this size.
VoxelGrid voxel_grid(const CloudView& cloud, const std::vector<Index>& points, double voxel);

/// The bounds of the edge of a voxel, in metres. Within them, squares of lengths are neither zero
/// nor infinite, and a length of a few voxels fits into a float.
inline constexpr double kLeastVoxel = 1e-30, kMostVoxel = 1e30;
/// The largest coordinate of a corner, in voxels, for which the coordinates of neighbouring corners
/// are exact.
inline constexpr double kMostExactCell = 1ULL << 52;

/// Checks that neighbouring cells have different coordinates, as a search for neighbours needs.
/// @throws Error (usage), which names a voxel that is beyond kMostExactCell.
void require_exact_cells(const VoxelGrid& grid, double voxel);

}  // namespace ph::segment
