// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// For each point, the first point that is equal to it. This may be the point itself. Takes O(n log
/// n) time.
/// @param points fewer than 2^32 points with finite coordinates; -0 equals +0.
std::pmr::vector<std::uint32_t> first_equal_points(PointsView points, const RunContext& context);

/// The first point of each class of equal points, ascending.
/// @param first_equal the result of `first_equal_points`.
std::pmr::vector<std::uint32_t> distinct_points(std::span<const std::uint32_t> first_equal,
                                                const RunContext& context);

}  // namespace ph
