// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"

namespace ph::segment {

/// Wins back the base of each object, that is, the strip of it that lies within the margin of the
/// plane and was therefore taken for the plane. If, over a small square of the plane, the lowest
/// point beyond the margin is just beyond it, the points of the strip over the same square join
/// this point's voxel. A wall has such a point; the free plane beside it has none. Centroids and
/// counts of the voxels do not change.
/// @param strip the points within the margin. @param side of a square, metres.
/// @param points the points in the grid, which lie beyond the margin or behind the plane; the
/// points of the bases are appended.
void assign_base_points(const CloudView& cloud, const std::vector<Index>& strip, const Plane& plane,
                        const PlaneMargin& margin, double side, std::vector<Index>& points,
                        VoxelGrid& grid);

}  // namespace ph::segment
