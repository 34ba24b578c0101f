// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// The share of a cloud that its supporting plane should have hidden from the viewpoint. A sensor
/// sees past the edge of a table but not through the table: a large share means that the viewpoint
/// is wrong. Looks at some thousands of the points.
/// @param points the points in range, without holes.
PlaneSight sight_past(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                      const PlaneMargin& margin);

}  // namespace ph::segment
