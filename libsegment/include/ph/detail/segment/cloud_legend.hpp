// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/segment/cloud_picture.hpp"
#include "ph/io/plot.hpp"

namespace ph::segment {

/// Adds a legend of the colours to a picture. The legend lists the largest segments, each with its
/// number and how many points it has, then how many other segments there are, and how many points
/// are in no segment. Listed segments have their number on the picture where there is room for it.
/// @param numbers the names of the segments; empty: their labels.
ColouredPicture with_legend(CloudPicture picture, std::span<const std::uint32_t> colours,
                            std::span<const std::uint32_t> numbers);

}  // namespace ph::segment
