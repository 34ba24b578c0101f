// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "voxel_pairs.hpp"

namespace ph::segment {

/// What is known of the surface at the voxels.
struct Surface {
  Points normals;                ///< one a voxel, see surface_normals
  std::vector<VoxelPair> pairs;  ///< voxels that are near each other
};

/// Joins the visible parts of one object. Two parts belong together
/// - if they meet without a seam: the surface is not concave where they do (the inside of a bowl
///   and its outside, over the rim);
/// - if one surface goes through both behind something nearer that hides its middle: enough voxels
///   at the occluder have one on the other side such that each lies in the tangent plane of the
///   other and the line between them is hidden.
/// @param part_of each voxel: one of the voxels of its part. @param min_size parts with fewer
/// voxels stay by themselves. @return the same for the objects.
std::vector<Index> join_parts(const VoxelGrid& grid, const Surface& surface, double voxel,
                              const Vec3& viewpoint, const std::vector<Index>& part_of,
                              Index min_size);

}  // namespace ph::segment
