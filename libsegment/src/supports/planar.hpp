// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// How far from a plane at range r voxels may lie that are on it, metres: as depth from disparity
/// is noisy.
double flatness(double square_of_range);

/// The plane on which the voxels of a flat thing lie, turned towards the viewpoint; nothing if they
/// lie on no plane. Least squares, from the mean of the normals on.
/// @param voxels some of the vertices. @return its share is that of these voxels.
std::optional<Plane> plane_through(const Points& centroids, const Points& normals,
                                   std::span<const Index> voxels, const Vec3& viewpoint);

/// How many of the voxels lie on a plane.
Index count_on(const Plane& plane, const Points& centroids, std::span<const Index> voxels,
               const Vec3& viewpoint);
/// The share of them.
double share_on(const Plane& plane, const Points& centroids, std::span<const Index> voxels,
                const Vec3& viewpoint);

}  // namespace ph::segment
