// SPDX-License-Identifier: MIT
#pragma once
#include "ph/io/plot.hpp"
#include "pictures/cloud_picture.hpp"

namespace ph::segment {

/// The picture with what its colours mean: the largest segments by number, with their points, how
/// many others there are, and the points in none. Those listed have their number on the picture
/// where there is room for it.
/// @param numbers what each segment is called; empty: by its label.
ColouredPicture with_legend(CloudPicture picture, std::span<const std::uint32_t> colours,
                            std::span<const std::uint32_t> numbers);

}  // namespace ph::segment
