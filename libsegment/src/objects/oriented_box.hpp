// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "ph/scene_tree.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The coordinates of one or more points. There is one array each for x, y and z, so that the
/// compiler can vectorise loops over them.
struct Coordinates {
  std::span<const float> x, y, z;
};

/// The axis-aligned box of points.
Box box_around(const Coordinates& points);

/// The box of points on a plane. Its base is the smallest rectangle around their projections onto
/// the plane, and it extends to their heights. One side of this rectangle is along an edge of the
/// convex hull (Freeman & Shapira 1975). Rotating calipers find this side (Toussaint 1983). Takes
/// O(n) time plus O(h log h) for the h points near the hull.
/// @param up the unit normal of the plane.
OrientedBox box_on_plane(const Coordinates& points, const Vec3& up);

/// The same for some points of a cloud. The size of the box of no points is zero.
OrientedBox box_on_plane(const CloudView& cloud, const std::vector<Index>& points, const Vec3& up);

/// The box of points along given axes. @param axes three orthogonal unit vectors.
OrientedBox box_along(const Coordinates& points, const std::array<Vec3, 3>& axes);

/// The principal axes of weighted places, right-handed, with the largest spread first. The last
/// axis points towards the viewpoint. @param places one per row, at least one.
std::array<Vec3, 3> principal_axes(const Points& places, std::span<const double> weights,
                                   const Vec3& viewpoint);

}  // namespace ph::segment
