// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace ph::report {

/// Pairs of leaves that are adjacent in the picture that a camera took, each pair once with the
/// smaller leaf first. One leaf is to the right of the other or below it, with at most a few pixels
/// without a leaf in between, as occur where one thing hides another. In space, such leaves may be
/// far apart.
/// @param index of each point its pixel, row by row, ascending. @param leaf of each point; kNone:
///     none.
/// @param width of the picture, > 0. O(n log n).
std::vector<std::uint32_t> touching_in_picture(std::span<const std::uint32_t> index,
                                               std::span<const std::uint32_t> leaf,
                                               std::size_t width);

}  // namespace ph::report
