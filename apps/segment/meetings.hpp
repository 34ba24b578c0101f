// SPDX-License-Identifier: MIT
#pragma once
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// Two vertices in different segments, with an edge between them.
struct Contact {
  std::uint32_t u, v;
  double value;  ///< at which the edge enters
};

/// Gives each segment its neighbours, where they meet, and its persistence.
void find_neighbours(const MergeTree& tree, const std::vector<Contact>& contacts, SceneCut& cut);

}  // namespace ph::segment
