// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "plane/plane.hpp"

namespace ph::segment {

/// The points of some squares of a plane on which nothing stands, both near and far: they show the
/// sensor's noise. Empty if there are no such squares.
/// @param on_plane points on the plane. @param beyond points that stand on it.
/// @param side of a square, metres. @return indices into the cloud, in the order of `on_plane`.
std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& on_plane,
                                const std::vector<Index>& beyond, const Plane& plane, double side);

}  // namespace ph::segment
