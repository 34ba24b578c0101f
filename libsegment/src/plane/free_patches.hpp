// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// The points of some squares of a plane on which nothing stands, near ones and far ones alike:
/// what is measured there is the noise of the sensor. None if there are no such squares.
/// @param on_plane points on the plane. @param beyond those that stand on it.
/// @param side of a square, metres. @return indices into the cloud, in the order of `on_plane`.
std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& on_plane,
                                const std::vector<Index>& beyond, const Plane& plane, double side);

}  // namespace ph::segment
