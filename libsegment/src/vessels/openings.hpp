// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "plane/plane.hpp"
#include "voxels/voxel_grid.hpp"

namespace ph::segment {

/// Whether a point may have been won back for a voxel through an opening: all that such points have
/// in common. It is near the voxel and lower, and not far below the plane: a shiny bottom is seen
/// deeper than it is.
bool may_be_in_opening(const Plane& plane, const Vec3& point, const Vec3& voxel);

/// Wins back the bottoms of round vessels (bowls, cups, pots), which lie so low that they were
/// taken for the plane: what the sensor sees through the opening of a rim is inside the vessel. A
/// rim is the upper end of an object if that lies on a circle, on most of it, and the middle of the
/// circle is free.
/// What is won back goes with its voxel in any other cut; openings are not looked for again.
/// @param object_of each voxel: one of the voxels of its object. @param min_size fewest voxels of
/// an object. @param in_range all points of which some may be inside. @param points those in the
/// grid; those of bottoms are appended, and `grid.voxel_of` says to which voxel of the object they
/// go: the lowest one that is nearest to the axis. O(voxels + points near the plane, for each rim).
void assign_points_in_openings(const CloudView& cloud, const std::vector<Index>& in_range,
                               const Plane& plane, double voxel,
                               const std::vector<Index>& object_of, Index min_size,
                               std::vector<Index>& points, VoxelGrid& grid);

}  // namespace ph::segment
