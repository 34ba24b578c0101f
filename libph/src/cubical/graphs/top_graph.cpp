// SPDX-License-Identifier: MIT
#include "libph/src/cubical/graphs/top_graph.hpp"

#include "ph/detail/core/on_first_use.hpp"

namespace ph::cubical {

std::array<std::uint32_t, 2> TopGraph::ends(std::uint32_t v, std::uint32_t number) const {
  const Direction d = bridge_direction(number);
  const int n = static_cast<int>(number);
  const int normal = has_cubes() ? normal_of_square(n) : 3 - axis_of_edge(n);
  return {node(v, turned(d, normal, -1)), node(v, turned(d, normal, 1))};
}

std::uint32_t TopGraph::arrow(std::uint32_t node) const {
  const StarCell top = cell(node);
  const int number = number_of(top.direction);
  const int axis = exit_axis(top.voxel, number);
  return this->node(top.voxel, turned(top.direction, axis, -top.direction[axis]));
}

const TopGraph::SquareWords& TopGraph::square_words() {
  static constinit detail::OnFirstUse words([] {
    SquareWords made{};
    const StarTables& tables = star_tables(0);
    for (std::uint32_t squares = 0; squares < made.size(); ++squares) {
      const std::uint32_t star = squares << kSquareShift;
      made[squares] = arrow_word(tables.edge_squares(star), kSquares,
                                 [&](int s) { return exit_of_square(tables.edge_of(star, s)); });
    }
    return made;
  });
  return *words;
}

StarCell TopGraph::cell(std::uint32_t node) const {
  StarCell found;
  for_each_corner(node, [&](std::uint32_t v, const Direction& d) {
    const std::uint32_t star = grid_.star(v);
    if (star == kAbsent || (star & star_bit(d)) == 0) return false;
    found = {v, d};
    return true;
  });
  return found;
}

}  // namespace ph::cubical
