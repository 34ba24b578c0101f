// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/segment/cloud_picture.hpp"
#include "ph/io/plot.hpp"

namespace ph::segment {

/// The picture with a legend of its colours: the largest segments by number and with their points,
/// the number of other segments, and the number of points in no segment. Listed segments have their
/// number on the picture where there is room for it.
/// @param numbers the names of the segments; empty: their labels.
ColouredPicture with_legend(CloudPicture picture, std::span<const std::uint32_t> colours,
                            std::span<const std::uint32_t> numbers);

}  // namespace ph::segment
