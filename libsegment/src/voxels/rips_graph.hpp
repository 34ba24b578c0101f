// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/metric/metric.hpp"

namespace ph::segment {

/// The 1-skeleton of the Vietoris-Rips filtration of points in space, which is all that H0 needs
/// (Section V.A of the paper). Vertices enter at 0, and edges enter at their length. The filtration
/// equals the filtration of ph::Rips, without the data for higher dimensions.
/// @param points one point of R^3 per row, finite. @param distance the longest edge, >= 0,
/// inclusive.
/// @param steps the number of levels up to `distance` to which lengths are rounded up; 0 for exact
/// lengths. Takes O(points log points + edges) time for voxels not much smaller than `distance`.
/// @throws Error (resource) if there are more than 2^32 - 2 cells, or beyond the memory limit.
FilteredGraph rips_graph(const Points& points, double distance, int steps,
                         const RunContext& context = default_context());

/// A value of the filtration. It is the smallest of the levels 0, distance/steps, 2*distance/steps,
/// …, distance that is not below `length`. If `steps` is 0, it is `length` itself.
/// @param length from 0 to `distance`.
double filtration_value(double length, double distance, int steps);

}  // namespace ph::segment
