// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/run_context.hpp"
#include "ph/metric/metric.hpp"

namespace ph {

/// The first point of each class of equal ones, ascending. O(n log n).
/// @param points fewer than 2^32 of them, finite; -0 equals +0.
std::pmr::vector<std::uint32_t> first_of_equal_points(const Points& points,
                                                      const RunContext& context);

}  // namespace ph
