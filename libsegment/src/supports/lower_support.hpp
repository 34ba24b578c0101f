// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// A support below another support, for example the floor or a drawer below a table.
struct LowerSupport {
  Plane plane;
  PlaneMargin margin;
  std::vector<Index> points;  ///< below the upper support: all that can stand on this one
};

/// The largest plane below a support if it is parallel to the support and nothing of the whole
/// frame is visible below it.
/// @param points in range, without holes. @param least_margin of the plane that is found, as
/// PlaneMargin::noise.
std::optional<LowerSupport> find_lower_support(const CloudView& cloud,
                                               const std::vector<Index>& points, const Plane& upper,
                                               double least_margin);

}  // namespace ph::segment
