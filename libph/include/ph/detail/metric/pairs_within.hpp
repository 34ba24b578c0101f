// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Calls `visit(i, j, distance)` once for each pair i < j of points at Euclidean distance <=
/// radius, in an order that depends on the input alone. In up to three dimensions, it uses cubes as
/// wide as the radius, if the radius is at least 1e-139. Otherwise it uses a k-d tree, or compares
/// all pairs if there are few points. O(n log n + pairs) unless most points lie within a billionth
/// of the largest coordinate.
/// @param points one per row, finite. @param radius in units of the coordinates.
/// @throws Error (usage) if the radius is negative or NaN; Error (bad_data) as PointMetric;
///         Error (cancelled) on a stop request.
void for_each_pair_within(PointsView points, double radius,
                          const std::function<void(Index, Index, double)>& visit,
                          const RunContext& context = default_context());

}  // namespace ph
