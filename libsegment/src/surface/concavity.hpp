// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "voxels/voxel_pairs.hpp"

namespace ph::segment {

/// Normals of the surface at each voxel, turned towards the viewpoint, unit length: the direction
/// in which the centroids within a radius spread least. NaN where fewer than three are near.
/// @param pairs of voxels, at least those within `radius`.
Points surface_normals(const Points& centroids, std::span<const VoxelPair> pairs, double radius,
                       const Vec3& viewpoint);

/// The sum of the sines of the angles at which the surface rises at each of two voxels from the
/// line between them, (n_v - n_u)·(u - v)/|u - v|: above 0 in a valley, below on a ridge, NaN
/// without a normal. The same from both sides.
double rise(const Points& centroids, const Points& normals, const VoxelPair& pair);

/// How much the surface is hollowed out at each voxel: the mean rise over the voxels near it, or 0
/// where that is negative. It is about 0 where the surface is flat or
/// bulges, and large along the seam where one object stands on or touches another (the criterion of
/// LCCP; Stein, Schoeler, Papon & Wörgötter, Object partitioning using local convexity, 2014).
/// @param pairs of voxels: who is near whom.
std::vector<double> concavity(const Points& centroids, const Points& normals,
                              std::span<const VoxelPair> pairs);

/// Each value becomes the mean of itself and those of its neighbours.
/// @param pairs those with distance < `radius` are neighbours.
std::vector<double> smoothed(const std::vector<double>& values, std::span<const VoxelPair> pairs,
                             double radius);

}  // namespace ph::segment
