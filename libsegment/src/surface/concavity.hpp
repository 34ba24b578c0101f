// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "libsegment/src/voxels/voxel_pairs.hpp"

namespace ph::segment {

/// Normals of the surface at each voxel, of unit length, pointing towards the viewpoint: the
/// direction in which the centroids within a radius spread least. NaN where fewer than three are
/// near.
/// @param pairs of voxels, including all pairs within `radius`.
Points surface_normals(const Points& centroids, std::span<const VoxelPair> pairs, double radius,
                       const Vec3& viewpoint);

/// The sum of the sines of the angles at which the surface rises at each of two voxels from the
/// line between them, (n_v - n_u)·(u - v)/|u - v|: above 0 in a valley, below 0 on a ridge, NaN
/// without a normal. Symmetric in the two voxels.
double rise(const Points& centroids, const Points& normals, const VoxelPair& pair);

/// The concavity of the surface at each voxel: the mean rise over the voxels near it, or 0 where
/// the mean is negative. It is about 0 where the surface is flat or convex, and large along the
/// seam where one object stands on or touches another (the criterion of LCCP; Stein, Schoeler,
/// Papon & Wörgötter, Object partitioning using local convexity, 2014).
/// @param pairs of voxels that are near each other.
std::vector<double> concavity(const Points& centroids, const Points& normals,
                              std::span<const VoxelPair> pairs);

/// Replaces each value by the mean of itself and its neighbours' values.
/// @param pairs neighbours are pairs with distance < `radius`.
std::vector<double> smoothed(const std::vector<double>& values, std::span<const VoxelPair> pairs,
                             double radius);

}  // namespace ph::segment
