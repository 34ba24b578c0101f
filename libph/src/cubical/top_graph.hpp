// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "star_grid.hpp"

namespace ph::cubical {

/// The cells of the highest dimension (two or three), numbered by their corner that comes first,
/// and what has always been there: the outside, in two parts where one axis alone has ends, and
/// cells that never enter. Roots are critical top cells, bridges critical facets. The same as the
/// graph of voxels for the image turned around.
class TopGraph {
 public:
  static constexpr bool kBackwards = true;

  explicit TopGraph(const StarGrid& grid);

  std::size_t size() const { return std::size_t{count_} + 2; }
  std::uint32_t outside(int part) const { return count_ + static_cast<std::uint32_t>(part); }
  Direction root_direction(std::uint32_t n) const { return has_cubes() ? kCubes[n] : kSquares[n]; }
  Direction bridge_direction(std::uint32_t n) const {
    return has_cubes() ? kSquares[n] : kEdges[n];
  }

  /// Out of a cell by the facet that it is paired with. Precondition: the cell enters and is not
  /// critical.
  std::uint32_t arrow(std::uint32_t node) const;
  template <class Use>
  void for_each_arrow(Use&& use, Ticker& ticker) const;
  /// Whether anything but the outside has always been there.
  bool has_endless() const { return !grid_.relative() && !grid_.all_enter(); }
  /// Calls `use(node)` for what hangs together because a voxel never enters: all top cells around
  /// it.
  template <class Use>
  void for_each_endless(std::uint32_t v, Use&& use) const;
  /// Calls `use(node, number)` for the roots in the star of a voxel, in the order of the grid.
  template <class Use>
  void for_each_root(std::uint32_t v, Use&& use) const;
  /// Calls `use(node, node, number)` for the bridges in the star of a voxel, in the order of the
  /// grid.
  template <class Use>
  void for_each_bridge(std::uint32_t v, Use&& use) const;

 private:
  bool has_cubes() const { return grid_.top_dim() == 3; }
  /// The top cell in a direction from a voxel.
  std::uint32_t node(std::uint32_t v, const Direction& d) const;
  /// The axis along which a top cell is left, by its number in its star.
  int exit_axis(const StarTables& tables, std::uint32_t star, int number) const {
    return has_cubes() ? tables.pair_cubes(star).exit(number)
                       : 3 - axis_of_edge(tables.edge_of(star, number));  // the other of 1 and 2
  }
  /// The star that a top cell is in. Precondition: there is one.
  StarCell cell(std::uint32_t node) const;
  std::uint32_t outside_beyond(const Direction& d) const;

  const StarGrid& grid_;
  std::array<std::uint32_t, 3> extent_{}, stride_{}, border_{};
  std::array<Divisor, 3> by_extent_;
  std::uint32_t count_ = 1;
};

template <class Use>
void TopGraph::for_each_arrow(Use&& use, Ticker& ticker) const {
  // By place_of a direction: from the cell towards +, +, + of a voxel to that in the direction, and
  // at which borders (bit 2a at the first voxel along a, 2a + 1 at the last one) that leaves the
  // graph or comes back on the other side.
  std::array<std::uint32_t, 27> offset{};
  std::array<unsigned, 27> leaves{};
  const auto prepare = [&](const Direction& d) {
    for (int a = 0; a < 3; ++a) {
      if (d[a] == 0) continue;
      if (d[a] < 0) offset[place_of(d)] -= stride_[a];
      if (border_[a] == 0) leaves[place_of(d)] |= 1U << (2 * a + (d[a] > 0 ? 1 : 0));
    }
  };
  for (const Direction& d : has_cubes() ? std::span<const Direction>(kCubes) : kSquares) prepare(d);
  const auto at_borders = [&](int a, std::uint32_t x) {
    return (x == 0 ? 1U << (2 * a) : 0U) | (x + 1 == grid_.extent(a) ? 2U << (2 * a) : 0U);
  };
  std::uint32_t v = 0;
  for (std::uint32_t z = 0; z < grid_.extent(0); ++z)
    for (std::uint32_t y = 0; y < grid_.extent(1); ++y) {
      const unsigned row_borders = at_borders(0, z) | at_borders(1, y);
      const std::uint32_t base =
          (z + border_[0]) * stride_[0] + (y + border_[1]) * stride_[1] + border_[2] * stride_[2];
      ticker.work(grid_.extent(2));
      for (std::uint32_t x = 0; x < grid_.extent(2); ++x, ++v) {
        const std::uint32_t star = grid_.star(v);
        const StarTables& tables = grid_.tables(v);
        const unsigned paired =
            has_cubes() ? StarTables::cubes(star) & ~tables.pair_cubes(star).critical_cubes()
                        : tables.edge_squares(star);
        const unsigned borders = row_borders | at_borders(2, x);
        const auto near = [&](const Direction& d) {
          const int place = place_of(d);
          return (leaves[place] & borders) != 0 ? node(v, d)
                                                : base + x * stride_[2] + offset[place];
        };
        for (unsigned rest = paired; rest != 0; rest &= rest - 1) {
          const int number = std::countr_zero(rest);
          const Direction d = root_direction(static_cast<std::uint32_t>(number));
          const int axis = exit_axis(tables, star, number);
          use(near(d), near(turned(d, axis, -d[axis])));
        }
      }
    }
}

template <class Use>
void TopGraph::for_each_endless(std::uint32_t v, Use&& use) const {
  for (const Direction& d : kCubes) {
    Direction inside = d;
    bool is_first = true;  // of those that differ along axes that are not there
    for (int a = 0; a < 3; ++a)
      if (!grid_.has_axis(a)) {
        is_first = is_first && d[a] < 0;
        inside[a] = 0;
      }
    if (is_first) use(node(v, inside));
  }
}

template <class Use>
void TopGraph::for_each_root(std::uint32_t v, Use&& use) const {
  const std::uint32_t star = grid_.star(v);
  const StarTables& tables = grid_.tables(v);
  const auto use_cell = [&](int number) {
    const auto n = static_cast<std::uint32_t>(number);
    use(node(v, root_direction(n)), n);
  };
  if (!has_cubes())
    for_each_in_order(
        tables.critical_squares(star, {}), kSquareCount,
        [&](int rank) { return tables.square_at(rank); }, use_cell);
  else if (StarTables::cubes(star) == 255)
    for_each_in_order(
        tables.pair_cubes(star).critical_cubes(), kCubeCount,
        [&](int rank) { return tables.cube_at(rank); }, use_cell);
}

template <class Use>
void TopGraph::for_each_bridge(std::uint32_t v, Use&& use) const {
  const std::uint32_t star = grid_.star(v);
  const StarTables& tables = grid_.tables(v);
  const auto use_facet = [&](int number) {
    const auto n = static_cast<std::uint32_t>(number);
    const Direction d = bridge_direction(n);
    const int normal = has_cubes() ? normal_of_square(number) : 3 - axis_of_edge(number);
    use(node(v, turned(d, normal, -1)), node(v, turned(d, normal, 1)), n);
  };
  if (has_cubes())
    for_each_in_order(
        tables.critical_squares(star, tables.pair_cubes(star)), kSquareCount,
        [&](int rank) { return tables.square_at(rank); }, use_facet);
  else
    for_each_in_order(
        tables.critical_edges(star), kEdgeCount, [&](int rank) { return tables.edge_at(rank); },
        use_facet);
}

}  // namespace ph::cubical
