// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

#include "ph/points.hpp"
#include "ph/rips.hpp"

namespace ph {

/// What a Rips filtration that holds these points and no edges would need; empty: nothing more.
std::string_view obstacle_to_points_alone(PointsView points, const RipsOptions& options);

}  // namespace ph
