// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The components that are large enough, and a label for each point. Neighbours are not set.
/// @param component_of each vertex: one of its component's vertices, the same for the whole
///     component.
/// @param min_size fewest voxels of a segment.
SceneCut extract_components(const SceneTree& scene, const std::vector<Index>& component_of,
                            Index min_size);

}  // namespace ph::segment
