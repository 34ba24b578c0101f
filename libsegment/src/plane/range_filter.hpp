// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// The points that are not holes, lie at most `max_range` metres from the viewpoint and, with a
/// crop box, lie inside it. Ascending indices. @param max_range >= 0, may be infinite.
std::vector<Index> range_filter(const CloudView& cloud, double max_range,
                                const std::optional<Box>& crop);

}  // namespace ph::segment
