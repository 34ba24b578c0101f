// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <memory_resource>
#include <utility>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// For two segments, the smaller label first, the value of the first edge between them.
using Contacts = std::pmr::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// Sets the neighbours of each segment, where they meet, and its persistence.
void find_neighbours(const MergeTree& tree, const Contacts& contacts, SceneCut& cut);

}  // namespace ph::segment
