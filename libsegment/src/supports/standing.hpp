// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "ph/scene_tree.hpp"
#include "voxels/voxel_pairs.hpp"

namespace ph::segment {

/// Says of each segment what it stands on, and whether it is an object or may be one.
/// A segment stands on a support if it reaches it: some of its points lie as low, over it. Else it
/// stands on the segment that it touches most at its own lower end, and not at that of the other.
/// What stands on nothing that is seen is an object, too, unless it is
/// cut off by the border of an organised cloud: then its role is unknown.
/// @param pairs of voxels that are near each other. Does nothing if there is no support.
void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut);

}  // namespace ph::segment
