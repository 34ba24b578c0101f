// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstdint>

namespace ph::alpha {

/// Tables of the positions 0 to 3 of vertices in a tetrahedron: the two ends of each edge, the edge
/// between each two positions, and the three vertices of each facet. Positions ascend.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdgeEnds{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> kEdgeBetween{
    {{6, 0, 1, 2}, {0, 6, 3, 4}, {1, 3, 6, 5}, {2, 4, 5, 6}}};
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kFacetPlaces{
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

/// The lowest position in a set, which must not be empty.
constexpr unsigned lowest(unsigned places) {
  return static_cast<unsigned>(std::countr_zero(places));
}

}  // namespace ph::alpha
