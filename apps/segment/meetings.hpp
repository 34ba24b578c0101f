// SPDX-License-Identifier: MIT
#pragma once
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// Gives each segment its neighbour, where they meet, and its persistence.
void find_neighbours(const MergeTree& tree, SceneCut& cut);

}  // namespace ph::segment
