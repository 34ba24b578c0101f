// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/methods.hpp"
#include "libsegment/src/plane/sample.hpp"
#include "ph/scene_tree.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// Removes all surfaces of a scene from its points: the walls, the ceiling, the supporting plane,
/// and the supports that are parallel to it. The objects on the supports stay. The surfaces and
/// their roles are added to the tree, the supporting plane first.
/// @param in_range the points in range. @param planes large planes other than the support.
/// @param sample a sample of the points in range. @param most_supports at least 1.
void clear_surfaces(const std::vector<Index>& in_range, const std::vector<Plane>& planes,
                    const Sample& sample, const PlaneSight& sight, Index most_supports,
                    Scene& scene, SceneTree& tree);

}  // namespace ph::segment
