// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// True if a point may have been won back for a voxel through an opening. All points that are won
/// back are near the voxel and not higher than it. They may be a little below the plane, because a
/// shiny bottom appears too deep.
bool may_be_in_opening(const Plane& plane, const Vec3& point, const Vec3& voxel);

/// Wins back the bottoms of round vessels (bowls, cups, pots), which are so low that they were
/// taken for the plane. Points that the sensor sees through the opening of a rim are inside the
/// vessel. The upper end of an object is a rim if it is on a circle, covers most of the circle, and
/// leaves the middle free. In other cuts, the points that were won back stay with their voxel, and
/// no openings are searched for.
/// @param object_of for each voxel, one of the voxels of its object. @param min_size the fewest
/// voxels of an object.
/// @param in_range all points in range, some of which may be inside a vessel.
/// @param points the points in the grid. The points of the bottoms are appended. In
/// `grid.voxel_of`, each of these points gets the lowest voxel of the object near the axis of the
/// opening. Takes O(voxels + points in range) time for each rim.
void assign_points_in_openings(const CloudView& cloud, const std::vector<Index>& in_range,
                               const Plane& plane, double voxel,
                               const std::vector<Index>& object_of, Index min_size,
                               std::vector<Index>& points, VoxelGrid& grid);

/// Finds the inside and the outside of round vessels (bowls, cups, pots) whose rims are too thin to
/// show a surface that joins the inside and the outside. The upper ends of both parts are then at
/// the same height and on one circle. Each part has its own arc, and the two arcs together cover
/// at least half of the circle.
/// @param up the unit normal of the support. @param join called with the numbers of the two parts
/// of a vessel.
/// @throws Error (cancelled) as `context` asks.
void join_around_rims(const Points& centroids, double voxel, const Vec3& up, const Parts& parts,
                      const std::function<void(std::uint32_t, std::uint32_t)>& join,
                      const RunContext& context = default_context());

}  // namespace ph::segment
