// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"

namespace ph::segment {

/// Wins back the base of each object, the strip that was taken for the plane because it lies within
/// its margin. A point of the strip joins the voxel of the lowest point beyond the margin over the
/// same small square of the plane, if that point is just beyond the margin. A wall has such points;
/// the free plane beside it has none. Centroids and counts of the voxels do not change.
/// @param strip the points within the margin. @param side of a square, metres.
/// @param points the points in the grid, which lie beyond the margin or behind the plane; the
/// points of the bases are appended.
void assign_base_points(const CloudView& cloud, const std::vector<Index>& strip, const Plane& plane,
                        const PlaneMargin& margin, double side, std::vector<Index>& points,
                        VoxelGrid& grid);

}  // namespace ph::segment
