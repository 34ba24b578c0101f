// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "star_grid.hpp"

namespace ph::cubical {

/// The cells of the highest dimension (two or three), numbered by their corner that comes first,
/// and what has always been there: the outside, in two parts where one axis alone has ends, and
/// cells that never enter. Roots are critical top cells, bridges critical facets, but for edges
/// that are marked: they are in pairs with voxels. The same as the graph of voxels for the image
/// turned around.
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
  /// Calls `use_arrow(node, node)` for all arrows and `use_root` as `for_each_root` does.
  template <class UseArrow, class UseRoot>
  void for_each_node(UseArrow&& use_arrow, UseRoot&& use_root, Ticker& ticker) const;
  /// Whether anything but the outside has always been there.
  bool has_endless() const { return !grid_.relative() && !grid_.all_enter(); }
  /// Calls `use(node)` for what hangs together because a voxel never enters: all top cells around
  /// it.
  template <class Use>
  void for_each_endless(std::uint32_t v, Use&& use) const;
  /// Calls `use(node, voxel, number)` for the roots in the star of a voxel, in the order of the
  /// grid.
  template <class Use>
  void for_each_root(std::uint32_t v, Use&& use) const;
  /// What a facet in the star of a voxel joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t v, std::uint32_t number) const;

 private:
  bool has_cubes() const { return grid_.top_dim() == 3; }
  /// The top cell in a direction from a voxel.
  std::uint32_t node(std::uint32_t v, const Direction& d) const;
  /// The axis along which a top cell is left, by its number in the star of a voxel.
  int exit_axis(std::uint32_t v, int number) const {
    if (has_cubes()) return grid_.pair_cubes(v).exit(number);
    return 3 - axis_of_edge(grid_.tables(v).edge_of(grid_.star(v), number));  // the other of 1, 2
  }
  /// The star that a top cell is in. Precondition: there is one.
  StarCell cell(std::uint32_t node) const;
  std::uint32_t outside_beyond(const Direction& d) const;

  const StarGrid& grid_;
  std::array<std::uint32_t, 3> extent_{}, stride_{}, border_{};
  unsigned inner_borders_ = 0;  // of axes without a border around them
  std::array<Divisor, 3> by_extent_;
  std::uint32_t count_ = 1;
};

template <class UseArrow, class UseRoot>
void TopGraph::for_each_node(UseArrow&& use_arrow, UseRoot&& use_root, Ticker& ticker) const {
  // By number of a top cell in a star: where it lies from the one towards +, +, +, at which borders
  // that is not so (it leaves the graph, or comes back on the other side), and what is across the
  // facet that it is left by.
  struct Step {
    std::uint32_t offset = 0;
    unsigned borders = 0;
    std::array<int, 3> across{};  // by axis
  };
  std::array<Step, kSquareCount> steps;
  const int count = has_cubes() ? kCubeCount : kSquareCount;
  for (int n = 0; n < count; ++n) {
    const Direction d = root_direction(static_cast<std::uint32_t>(n));
    steps[n].borders = border_of(d) & inner_borders_;
    for (int a = 0; a < 3; ++a) {
      if (d[a] < 0) steps[n].offset -= stride_[a];
      steps[n].across[a] = number_of(turned(d, a, -d[a]));
    }
  }
  grid_.for_each_row(ticker, [&](const StarGrid::Row& row) {
    std::uint32_t base = (row.z + border_[0]) * stride_[0] + (row.y + border_[1]) * stride_[1] +
                         border_[2] * stride_[2];
    for (std::uint32_t x = 0, v = row.first; x < grid_.extent(2); ++x, ++v, base += stride_[2]) {
      const std::uint32_t star = grid_.star(v);
      const unsigned all = has_cubes() ? StarTables::cubes(star) : StarTables::squares(star);
      if (all == 0) continue;
      const unsigned paired = has_cubes() ? all & ~grid_.pair_cubes(v).critical_cubes()
                                          : grid_.tables(v).edge_squares(star);
      const unsigned borders = grid_.borders(row, x);
      const auto near = [&](int n) {
        const Step& step = steps[n];
        return (step.borders & borders) != 0
                   ? node(v, root_direction(static_cast<std::uint32_t>(n)))
                   : base + step.offset;
      };
      for (unsigned rest = paired; rest != 0; rest &= rest - 1) {
        const int n = std::countr_zero(rest);
        use_arrow(near(n), near(steps[n].across[exit_axis(v, n)]));
      }
      if (paired != all) for_each_root(v, use_root);
    }
  });
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
    use(node(v, root_direction(n)), v, n);
  };
  if (!has_cubes())
    for_each_in_order(
        tables.critical_squares(star, {}), kSquareCount,
        [&](int rank) { return tables.square_at(rank); }, use_cell);
  else if (StarTables::cubes(star) == 255)
    for_each_in_order(
        grid_.pair_cubes(v).critical_cubes(), kCubeCount,
        [&](int rank) { return tables.cube_at(rank); }, use_cell);
}

}  // namespace ph::cubical
