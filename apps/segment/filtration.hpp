// SPDX-License-Identifier: MIT
#pragma once
#include "ph/complex/rips.hpp"

namespace ph::segment {

/// A value of the filtration: the smallest of the levels 0, distance/steps, 2*distance/steps, …,
/// distance that is not below `value`; `value` itself if `steps` is 0.
/// @param value from 0 to `distance`.
double filtration_value(double value, double distance, int steps);

/// The Vietoris-Rips filtration of the vertices up to the maximum distance (inclusive), in `steps`
/// equal steps or, with 0, in as many as there are distances. H0 needs the 1-skeleton alone: all
/// pairs at most `distance` apart, found by a k-d tree (Alg. 1 of the paper, lines 1-4).
Rips rips_filtration(const Points& vertices, double distance, int steps,
                     const RunContext& context = default_context());

}  // namespace ph::segment
