// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The known properties of the surface at the voxels.
struct Surface {
  Points normals;                  ///< one per voxel, see surface_normals
  VoxelPairs pairs;                ///< pairs of voxels that are near each other
  Vec3 viewpoint{};                ///< the viewpoint
  std::optional<Plane> support{};  ///< the plane that it stands on
};

/// Joins the visible parts of one object. Two parts belong together
/// - if they meet without a seam: the surface is not concave there (the inside of a bowl and its
///   outside, over the rim);
/// - if one surface passes through both behind something nearer that hides its middle: enough
///   voxels at the occluder have a partner on the other side such that each lies in the tangent
///   plane of the other and the line between them is hidden;
/// - if one round rim surrounds both: see rims.hpp.
/// @param part_of for each voxel, one of the voxels of its part. @param min_size parts with fewer
/// voxels stay by themselves. @return for each voxel one of the voxels of its object. O(voxels log
/// voxels + pairs) plus the pairs of parts that are near each other. @throws Error (cancelled) as
/// `context` asks.
std::vector<Index> join_parts(const VoxelGrid& grid, const Surface& surface, double voxel,
                              const std::vector<Index>& part_of, Index min_size,
                              const RunContext& context = default_context());

}  // namespace ph::segment
