// SPDX-License-Identifier: MIT
#include "libph/src/cubical/grid/star_tables.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "ph/detail/core/on_first_use.hpp"

namespace ph::cubical {
namespace {

// DisjointSets is not used, because it allocates memory and halves paths, which is not worthwhile
// for eight nodes.
template <std::size_t size>
int root_of(const std::array<int, size>& parent, int i) {
  while (parent[i] != i) i = parent[i];
  return i;
}

}  // namespace

StarTables::StarTables(unsigned wrapped)
    : edge_order_(kEdges, wrapped), square_order_(kSquares, wrapped), cube_order_(kCubes, wrapped) {
  for (unsigned e = 0; e < 64; ++e) {
    for (int rank = kEdgeCount - 1; rank >= 0; --rank)
      if (const int first = edge_order_.at(rank); (e >> first & 1U) != 0)
        arrow_[e] = static_cast<std::uint8_t>(first);
    of_edges_[e].lowest = static_cast<std::uint8_t>(1U << arrow_[e]);
    for (int s = 0; s < kSquareCount; ++s) {
      const auto [a, b] = kEdgesOfSquare[s];
      if ((e >> a & e >> b & 1U) != 0)
        of_edges_[e].squares_on |= static_cast<std::uint16_t>(1U << s);
    }
  }
  for (unsigned s = 0; s < 4096; ++s) {
    for (int c = 0; c < kCubeCount; ++c) {
      const bool on = (s >> square_of_cube(c, 0) & s >> square_of_cube(c, 1) &
                       s >> square_of_cube(c, 2) & 1U) != 0;
      if (on) of_squares_[s].cubes_on |= static_cast<std::uint8_t>(1U << c);
    }
    pair_edges(s);
    places_begin_[s] = place_count_;
    place_count_ += 1U << std::popcount(unsigned{of_squares_[s].cubes_on});
  }
}

// Runs Kruskal's algorithm with the elder rule on the link. The nodes are the edges of the star,
// and squares join them in order. When a square joins two components, the component whose oldest
// edge is younger dies. All edges of a component except the oldest are therefore killed. Each
// killed edge is then matched with the square that leads from it towards the oldest edge in the
// resulting tree.
void StarTables::pair_edges(unsigned squares) {
  std::array<int, kEdgeCount> parent{};
  std::iota(parent.begin(), parent.end(), 0);
  unsigned tree = 0;
  square_order_.for_each(squares, [&](int s) {
    int a = root_of(parent, kEdgesOfSquare[s][0]), b = root_of(parent, kEdgesOfSquare[s][1]);
    if (a == b) return;
    if (edge_order_.rank(b) < edge_order_.rank(a)) std::swap(a, b);
    parent[b] = a;
    tree |= 1U << s;
  });
  unsigned reached = 0;
  for (int e = 0; e < kEdgeCount; ++e)
    if (parent[e] == e) reached |= 1U << e;
  const unsigned roots = reached;
  auto& up = up_[squares];
  up.fill(-1);
  for (bool more = true; more;) {
    more = false;
    for (int s = 0; s < kSquareCount; ++s) {
      if ((tree >> s & 1U) == 0) continue;
      const auto [a, b] = kEdgesOfSquare[s];
      if ((reached >> a & 1U) == (reached >> b & 1U)) continue;
      const int far = (reached >> a & 1U) != 0 ? b : a;
      up[far] = static_cast<std::int8_t>(s);
      reached |= 1U << far;
      more = true;
    }
  }
  tree_[squares] = static_cast<std::uint16_t>(tree);
  of_squares_[squares].loops = static_cast<std::uint8_t>(std::popcount(squares & ~tree));
  of_squares_[squares].joined = static_cast<std::uint8_t>(63U & ~roots);
}

// Runs the same algorithm as `pair_edges` on the dual graph, in reverse order. The nodes are the
// eight triangles of the octahedron, which are cubes of the grid. Triangles outside the star were
// always there. Each square joins the two triangles beside it, and the youngest squares come first.
CubePairs StarTables::pair_cubes(std::uint32_t star) const {
  CubePairs pairs;
  const unsigned cubes = this->cubes(star), all = squares(star);
  if (cubes == 0) return pairs;
  const auto axis_of = [](int square) { return normal_of_square(square); };
  if (std::has_single_bit(cubes)) {
    const int c = std::countr_zero(cubes);
    int youngest = square_of_cube(c, 0);
    for (int a = 1; a < 3; ++a)
      if (const int s = square_of_cube(c, a); square_order_.rank(s) > square_order_.rank(youngest))
        youngest = s;
    pairs.set_exit(c, axis_of(youngest));
    pairs.set_squares(1U << youngest);
    return pairs;
  }
  std::array<int, kCubeCount> parent{};
  std::iota(parent.begin(), parent.end(), 0);
  const auto beside = [](int s, int sign) {
    return number_of(turned(kSquares[s], normal_of_square(s), sign));
  };
  const auto is_there = [&](int c) { return (cubes >> c & 1U) != 0; };
  // The root of a tree is a node that was always there, if the tree has one. Otherwise it is the
  // youngest node of the tree.
  const auto outlives = [&](int a, int b) {
    if (is_there(a) != is_there(b)) return !is_there(a);
    return cube_order_.rank(a) > cube_order_.rank(b);
  };
  unsigned tree = 0;
  const auto join = [&](int s, bool present) {
    int a = root_of(parent, beside(s, -1)), b = root_of(parent, beside(s, 1));
    if (a == b) return;
    if (outlives(b, a)) std::swap(a, b);
    parent[b] = a;
    if (present && is_there(b)) tree |= 1U << s;
  };
  for (int s = 0; s < kSquareCount; ++s)
    if ((all >> s & 1U) == 0) join(s, false);
  for (int rank = kSquareCount - 1; rank >= 0; --rank)
    if (const int s = square_order_.at(rank); (all >> s & 1U) != 0) join(s, true);
  pairs.set_squares(tree);
  unsigned reached = 255U & ~cubes;
  for (int c = 0; c < kCubeCount; ++c)
    if (is_there(c) && parent[c] == c) {
      pairs.set_critical(c);
      reached |= 1U << c;
    }
  while (reached != 255U) {
    for (int s = 0; s < kSquareCount; ++s) {
      if ((tree >> s & 1U) == 0) continue;
      const int a = beside(s, -1), b = beside(s, 1);
      if ((reached >> a & 1U) == (reached >> b & 1U)) continue;
      const int far = (reached >> a & 1U) != 0 ? b : a;
      pairs.set_exit(far, axis_of(s));
      reached |= 1U << far;
    }
  }
  return pairs;
}

const StarTables& star_tables(unsigned wrapped) {
  static constinit detail::OnFirstUse plain([] { return StarTables(0); });
  if (wrapped == 0) return *plain;
  static constinit detail::OnFirstUse others([] {
    return std::array{StarTables(1), StarTables(2), StarTables(3), StarTables(4),
                      StarTables(5), StarTables(6), StarTables(7)};
  });
  return (*others)[wrapped - 1];
}

}  // namespace ph::cubical
