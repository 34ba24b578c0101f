// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace ph::report {

/// Pairs of leaves that are beside each other in the picture that a camera took, each pair once and
/// the smaller leaf first: right of each other or below, with a few pixels of nothing or of no leaf
/// in between at most, as there are where one thing hides another. In space such leaves may be far
/// apart.
/// @param index of each point its pixel, row by row, ascending. @param leaf of each; kNone: none.
/// @param width of the picture, > 0. O(n log n).
std::vector<std::uint32_t> touching_in_picture(std::span<const std::uint32_t> index,
                                               std::span<const std::uint32_t> leaf,
                                               std::size_t width);

}  // namespace ph::report
