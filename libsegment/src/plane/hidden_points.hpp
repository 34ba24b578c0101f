// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// How much of a cloud its supporting plane should have hidden from the viewpoint: a sensor sees
/// past the edge of a table but not through it, so that much of it says that the viewpoint is
/// wrong. Looks at some thousands of the points.
/// @param points those in range, none of them a hole.
PlaneSight sight_past(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                      const PlaneMargin& margin);

}  // namespace ph::segment
