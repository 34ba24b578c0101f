// SPDX-License-Identifier: MIT
#pragma once
#include "diagram/wasserstein/assignment.hpp"

namespace ph::diagram {

/// Finds the best matching and its prices by shortest augmenting paths, one per point of the first
/// set (Jonker, Volgenant 1987). It is slower than an auction, but has no increments: the number of
/// its steps is bounded for any costs.
/// @param assignment in any state.
void assign_by_shortest_paths(Assignment& assignment, const RunContext& context);

}  // namespace ph::diagram
