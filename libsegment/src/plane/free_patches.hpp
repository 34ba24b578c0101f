// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// The points of some squares of the plane on which nothing stands, near ones and far ones alike:
/// what is measured there is the noise of the sensor. None if the plane has too few such squares.
/// @param points those in range, none of them a hole. @param beyond those that stand on the plane.
/// @param side of a square, metres. @return indices into the cloud, in the order of `points`.
std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& points,
                                const std::vector<Index>& beyond, const Plane& plane,
                                const PlaneMargin& margin, double side);

}  // namespace ph::segment
