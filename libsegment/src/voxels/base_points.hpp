// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"

namespace ph::segment {

/// Wins back the base of each object. The base is the strip of the object that is within the margin
/// of the plane and was therefore taken for the plane. If the lowest point beyond the margin over a
/// small square of the plane is just beyond the margin, the points of the strip over the same
/// square join this point's voxel. A wall has a lowest point just beyond the margin. The free plane
/// beside it has no such point. Centroids and counts of the voxels do not change.
/// @param strip the points within the margin. @param side the side of a square, in metres.
/// @param points the points in the grid, which are beyond the margin or behind the plane. The
/// points of the bases are appended.
void assign_base_points(const CloudView& cloud, const std::vector<Index>& strip, const Plane& plane,
                        const PlaneMargin& margin, double side, std::vector<Index>& points,
                        VoxelGrid& grid);

}  // namespace ph::segment
