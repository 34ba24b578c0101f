// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"

namespace ph::segment {

/// Recovers the base of each object. The base is the strip of the object that is within the margin
/// of the plane and was therefore taken for the plane. The plane is divided into small squares. For
/// each square, the function finds the lowest point over the square that is beyond the margin. If
/// this point is just beyond the margin, it belongs to the wall of an object. In this case, the
/// points of the strip over the square join the voxel of this point. Over the free plane next to a
/// wall, there is no such point. Centroids and counts of the voxels do not change.
/// @param strip the points within the margin. @param side the side of a square, in metres.
/// @param points the points in the grid, which are beyond the margin or behind the plane. The
/// points of the bases are appended.
void assign_base_points(const CloudView& cloud, const std::vector<Index>& strip, const Plane& plane,
                        const PlaneMargin& margin, double side, std::vector<Index>& points,
                        VoxelGrid& grid);

}  // namespace ph::segment
