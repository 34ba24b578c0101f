// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The margin of a plane, in metres, as a function of the square of the range. It allows for the
/// noise of depth from disparity.
double flatness(double square_of_range);

/// The plane of a flat object's voxels, facing the viewpoint. Empty if the voxels are not on a
/// plane. The plane is fitted by least squares, starting from the mean of the normals.
/// @param voxels some of the vertices. @return the plane, with the share of these voxels that are
/// on it.
std::optional<Plane> plane_through(const Points& centroids, const Points& normals,
                                   std::span<const Index> voxels, const Vec3& viewpoint);

/// The number of voxels that are on a plane.
Index count_on(const Plane& plane, const Points& centroids, std::span<const Index> voxels,
               const Vec3& viewpoint);
/// The share of the voxels that are on a plane.
double share_on(const Plane& plane, const Points& centroids, std::span<const Index> voxels,
                const Vec3& viewpoint);

}  // namespace ph::segment
