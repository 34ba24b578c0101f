// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "ph/scene_tree.hpp"
#include "voxels/voxel_pairs.hpp"

namespace ph::segment {

/// Says of each segment what it stands on, and whether it is an object or may be one.
/// A segment stands on a support if it reaches it: some of its points lie as low, over it. Else it
/// stands on the segment that it touches most from above: the surface of that one faces up where
/// the two meet, its own does not. What stands on nothing that is seen is an object if something
/// nearer hides its lower end, else unknown.
/// @param pairs of voxels that touch. Does nothing if there is no support.
void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs, double radius,
                            SceneCut& cut);

}  // namespace ph::segment
