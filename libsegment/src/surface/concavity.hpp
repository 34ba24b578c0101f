// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "libsegment/src/voxels/voxel_pairs.hpp"

namespace ph::segment {

/// The unit normal of the surface at each voxel, pointing towards the viewpoint. It is the
/// direction in which the centroids within a radius spread least. It is NaN if fewer than three
/// centroids are within the radius.
/// @param pairs pairs of voxels, including all pairs within `radius`.
Points surface_normals(const Points& centroids, std::span<const VoxelPair> pairs, double radius,
                       const Vec3& viewpoint);

/// Measures how steeply the surface rises from the line between two voxels. The rise is the sum of
/// the sines of the angles between surface and line at both ends, (n_v - n_u)·(u - v)/|u - v|. It
/// is above 0 in a valley, below 0 on a ridge, and NaN if a normal is missing. It does not change
/// if the voxels are exchanged.
double rise(const Points& centroids, const Points& normals, const VoxelPair& pair);

/// The principal concavity of the surface at each voxel: the rise in the direction in which the
/// surface rises most. It is the largest eigenvalue, on the tangent plane, of the mean of
/// rise · d dᵀ over the pairs of the voxel, where d is the direction of a pair; or 0 if that is
/// negative. It is about 0 where the surface is flat or convex, and large along the seam where one
/// object stands on or touches another (the criterion of LCCP; Stein, Schoeler, Papon & Wörgötter,
/// Object partitioning using local convexity, 2014).
/// @param pairs pairs of voxels that are near each other.
std::vector<double> concavity(const Points& centroids, const Points& normals,
                              std::span<const VoxelPair> pairs);

/// Replaces each value by the mean of the value itself and its neighbours' values.
/// @param pairs pairs of voxels; two voxels are neighbours if their distance is below `radius`.
std::vector<double> smoothed(const std::vector<double>& values, std::span<const VoxelPair> pairs,
                             double radius);

}  // namespace ph::segment
