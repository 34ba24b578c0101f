// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// Determines what each segment stands on. A segment stands on a support if it reaches down to it,
/// that is, if some of its points are as low as this support; of several, on the support nearest to
/// its lower end. Otherwise it stands on the segment that it touches most among those that it
/// touches at its own lower end but not at their lower ends. Also finds the legs of tables.
/// @param pairs pairs of voxels that are near each other.
void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut);

}  // namespace ph::segment
