// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "ph/scene_tree.hpp"
#include "voxels/voxel_pairs.hpp"

namespace ph::segment {

/// Determines for each segment what it stands on, and whether it is an object or may be one. A
/// segment stands on a support if it reaches it: some of its points lie over the support and as
/// low. Otherwise it stands on the segment that it touches most at its own lower end, unless this
/// is also the lower end of the other segment. A segment that stands on nothing visible is an
/// object as well, unless the border of an organised cloud cuts it off: then its role is unknown.
/// @param pairs of voxels that are near each other. Does nothing if there is no support.
void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut);

}  // namespace ph::segment
