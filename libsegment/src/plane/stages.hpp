// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The share of a cloud that its supporting plane should have hidden from the viewpoint. A sensor
/// sees past the edge of a table, but not through the table. A large share therefore means that the
/// viewpoint is wrong. The function looks at some thousands of the points.
/// @param points the points in range, without holes.
PlaneSight sight_past(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                      const PlaneMargin& margin);

/// The points of some squares of a plane on which nothing stands. Some squares are near the
/// viewpoint, and others are far from it. The points show the sensor's noise. Empty if there are no
/// such squares.
/// @param on_plane points on the plane. @param beyond points that stand on it.
/// @param side the side of a square, in metres. @return indices into the cloud, in the order of
/// `on_plane`.
std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& on_plane,
                                const std::vector<Index>& beyond, const Plane& plane, double side);

/// The points that are not holes, are at most `max_range` metres from the viewpoint and, with a
/// crop box, are inside the box. Their indices are ascending. @param max_range >= 0, may be
/// infinite.
std::vector<Index> range_filter(const CloudView& cloud, double max_range,
                                const std::optional<Box>& crop);

}  // namespace ph::segment
