// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <memory_resource>
#include <utility>
#include <vector>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The value of the first edge between two segments, for each pair of labels with the smaller label
/// first.
using Contacts = std::pmr::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// Sets the neighbours of each segment, the values where they meet, and the persistence of the
/// segment.
void find_neighbours(const MergeTree& tree, const Contacts& contacts, SceneCut& cut);

/// Extracts the components that are large enough, and a label for each point. Does not set the
/// neighbours.
/// @param component_of for each vertex, one of the vertices of its component. It is the same for
/// all vertices of the component.
/// @param min_size the fewest voxels of a segment.
SceneCut extract_components(const SceneTree& scene, const std::vector<Index>& component_of,
                            Index min_size);

}  // namespace ph::segment
