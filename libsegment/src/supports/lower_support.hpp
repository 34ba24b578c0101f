// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// A support below another one, for example the floor or a drawer below a table.
struct LowerSupport {
  Plane plane;
  PlaneMargin margin;
  std::vector<Index> points;  ///< what lies below the other one: all that can stand on this one
};

/// The largest plane below a support if it is parallel to it and nothing of the whole frame is seen
/// below it.
/// @param points in range, none of them a hole. @param least_margin of the plane that is found, as
/// PlaneMargin::noise.
std::optional<LowerSupport> find_lower_support(const CloudView& cloud,
                                               const std::vector<Index>& points, const Plane& upper,
                                               double least_margin);

}  // namespace ph::segment
