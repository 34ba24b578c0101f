// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "voxel_pairs.hpp"

namespace ph::segment {

/// Normals of the surface at each voxel, turned towards the viewpoint, unit length: the direction
/// in which the centroids within a radius spread least. NaN where fewer than three are near.
/// @param pairs of voxels, at least those within `radius`.
Points surface_normals(const Points& centroids, const std::vector<VoxelPair>& pairs, double radius,
                       const Vec3& viewpoint);

/// How much the surface is hollowed out at each voxel: the mean of (n_v - n_u)·(u - v)/|u - v| over
/// the voxels u near v, or 0 where that is negative. It is about 0 where the surface is flat or
/// bulges, and large along the seam where one object stands on or touches another: the sum of the
/// sines of the angles at which both surfaces rise from the line that joins them (the criterion of
/// LCCP; Stein, Schoeler, Papon & Wörgötter, Object partitioning using local convexity, 2014).
/// @param pairs of voxels: who is near whom.
std::vector<double> concavity(const Points& centroids, const Points& normals,
                              const std::vector<VoxelPair>& pairs);

/// Each value becomes the mean of itself and those of its neighbours.
/// @param pairs those with distance < `radius` are neighbours.
std::vector<double> smoothed(const std::vector<double>& values, const std::vector<VoxelPair>& pairs,
                             double radius);

}  // namespace ph::segment
