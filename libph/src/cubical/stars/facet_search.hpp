// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <tuple>

#include "libph/src/cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// Finds a cell in the star that contains it, which is the star of its youngest voxel. Returns
/// nothing if no star contains the cell.
inline std::optional<StarCell> in_its_star(const StarGrid& grid, std::uint32_t voxel,
                                           const Direction& direction) {
  const unsigned corners = 1U << dimension_of(direction);
  for (unsigned corner = 0; corner < corners; ++corner) {
    std::uint32_t v = voxel;
    Direction d = direction;
    unsigned bits = corner;
    for (int a = 0; a < 3 && v != StarGrid::kOutside; ++a) {
      if (direction[a] == 0) continue;
      if ((bits & 1U) != 0) {
        v = grid.step(v, a, direction[a]);
        d[a] = -d[a];
      }
      bits >>= 1U;
    }
    if (v != StarGrid::kOutside && grid.enters(v) && (grid.star(v) & star_bit(d)) != 0)
      return StarCell{v, d, grid.value(v)};
  }
  return std::nullopt;
}

/// True if a cell comes before another cell of its dimension in the order of the stars. Both cells
/// are given in their stars, with their values.
inline bool comes_before(const StarGrid& grid, const StarCell& a, const StarCell& b) {
  const auto rank = [&](const StarCell& cell) {
    const int number = number_of(cell.direction);
    const StarTables& tables = grid.tables(cell.voxel);
    return dimension_of(cell.direction) == 1 ? tables.edge_order().rank(number)
                                             : tables.square_order().rank(number);
  };
  if (a.value != b.value || a.voxel != b.voxel)
    return std::tie(a.value, a.voxel) < std::tie(b.value, b.voxel);
  return rank(a) < rank(b);
}

}  // namespace ph::cubical
