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
  std::optional<Plane> support{};  ///< the supporting plane, if there is one
};

/// Joins the visible parts of one object. Two parts belong together in each of these cases:
/// - They share a rim, like the inside and the outside of a bowl (see join_around_rims).
/// - Their surfaces continue each other behind an occluder that hides at most 15 cm.
/// @param part_of for each voxel, one of the voxels of its part. @param min_size parts with fewer
/// voxels are not joined.
/// @return for each voxel, one of the voxels of its object. Takes O(voxels log voxels + pairs)
/// time, plus time for the pairs of parts that are near each other.
/// @throws Error (cancelled) as `context` asks.
std::vector<Index> join_parts(const VoxelGrid& grid, const Surface& surface, double voxel,
                              const std::vector<Index>& part_of, Index min_size,
                              const RunContext& context = default_context());

}  // namespace ph::segment
