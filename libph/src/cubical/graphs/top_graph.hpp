// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "libph/src/cubical/graphs/top_nodes.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// The graph of top cells for two or three axes. Roots are critical top cells. Bridges are critical
/// facets; with two axes, edges that are marked as paired with voxels are left out. The graph
/// equals the graph of voxels of the image with reversed values.
class TopGraph : public TopNodes<StarGrid, 3> {
 public:
  using TopNodes::TopNodes;

  Direction root_direction(std::uint32_t n) const { return has_cubes() ? kCubes[n] : kSquares[n]; }
  Direction bridge_direction(std::uint32_t n) const {
    return has_cubes() ? kSquares[n] : kEdges[n];
  }

  /// The top cell on the other side of the facet with which a top cell is paired. Precondition: the
  /// given cell enters and is not critical.
  std::uint32_t arrow(std::uint32_t node) const;
  /// Calls `use(node, end of its arrow)` for the top cells before each row of voxels in a range of
  /// rows, except for some cells at the border.
  template <class Use>
  void for_each_inner_arrow(std::uint32_t first_row, std::uint32_t end_row, Use&& use) const;
  /// Calls `use(node, number in the star)` for the roots in the star of a voxel, in the order of
  /// the grid.
  template <class Use>
  void for_each_root(std::uint32_t v, Use&& use) const;
  /// True if the slab knows the arrow of a node in a seam, as in VoxelNodes.
  bool is_known_here(std::uint32_t node) const { return cell(node).direction != Direction{}; }
  /// The two nodes that a facet in the star of a voxel joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t v, std::uint32_t number) const;
  /// A top cell as a cell of a star; the direction is zero if the cell is in no star.
  StarCell cell(std::uint32_t node) const;
  /// The axis along which the arrow leaves a top cell, or nothing if the cell is critical.
  std::optional<int> exit_of(const StarCell& top) const {
    const int number = number_of(top.direction);
    const unsigned critical =
        has_cubes() ? grid_.pair_cubes(top.voxel).critical_cubes()
                    : grid_.tables(top.voxel).critical_squares(grid_.star(top.voxel), {});
    if ((critical >> number & 1U) != 0) return std::nullopt;
    return exit_axis(top.voxel, number);
  }

 private:
  bool has_cubes() const { return grid_.top_dim() == 3; }
  /// The axis along which the arrow leaves a top cell, given by its number in the star of a voxel.
  int exit_axis(std::uint32_t v, int number) const {
    if (has_cubes()) return grid_.pair_cubes(v).exit(number);
    return exit_of_square(grid_.tables(v).edge_of(grid_.star(v), number));
  }
  /// The axis along which the arrow leaves a square, given the edge with which the square is
  /// paired: axis 1 or axis 2, whichever is not the axis of the edge.
  static int exit_of_square(int edge) { return 3 - axis_of_edge(edge); }
  /// The word that encodes the arrows of the top cells in a voxel's star (see
  /// for_each_inner_arrow).
  template <class Directions, class ExitOf>
  static std::uint32_t arrow_word(unsigned cells, const Directions& directions, ExitOf&& exit_of);
  /// The words of all sets of squares in a star of an image with two axes. They are made once, on
  /// first use, because making them takes longer than a small image takes.
  using SquareWords = std::array<std::uint32_t, 1 << kSquareCount>;
  static const SquareWords& square_words();
  /// True if a top cell and the two cells beside it along the axis lie between consecutive voxels.
  /// @param low the coordinate of the cell's first voxel.
  bool is_inner(int axis, std::uint32_t low) const {
    const std::uint32_t n = grid_.extent(axis), border = border_[static_cast<std::size_t>(axis)];
    return low >= 1 - border && low < n && n - low > 2 - border && !grid_.is_wrapped(axis, low) &&
           !grid_.is_wrapped(axis, low + 1);
  }
};

// Each voxel has a word that describes which top cells around it are in its star, and where the
// arrows of these cells lead. Bit 3u + a is set if the voxel is corner u of a cell in its star
// whose arrow leaves along axis a. (Along each axis a, corner u of a cell has the coordinate of the
// first corner plus bit a of u.) A cell is in the star of at most one of its corners. Combining the
// matching bits of all corners therefore gives at most one bit, without unpredictable branches.
template <class Use>
void TopGraph::for_each_inner_arrow(std::uint32_t first_row, std::uint32_t end_row,
                                    Use&& use) const {
  std::array<std::uint32_t, 24> offset{};  // indexed by bit
  for (std::uint32_t bit = 0; bit < offset.size(); ++bit) {
    const std::uint32_t u = bit / 3, a = bit % 3;
    offset[bit] = (u >> a & 1U) != 0 ? stride_[a] : 0 - stride_[a];
  }
  const SquareWords* const of_squares = has_cubes() ? nullptr : &square_words();
  const auto word_of = [&](std::uint32_t v) {
    const std::uint32_t star = grid_.star(v);
    if (of_squares != nullptr) return (*of_squares)[StarTables::squares(star)];
    const CubePairs pairs = grid_.pair_cubes(v);
    return arrow_word(StarTables::cubes(star) & ~pairs.critical_cubes(), kCubes,
                      [&](int c) { return pairs.exit(c); });
  };
  // The words of a row and of the preceding rows that share cells with it.
  const std::uint32_t width = grid_.extent(2), height = grid_.extent(1);
  const std::uint32_t layers = has_cubes() ? 2 : 1, kept = (layers - 1) * height + 2;
  std::vector<std::uint32_t> words(std::size_t{kept} * width);
  const auto words_of = [&](std::uint32_t r) { return &words[std::size_t{r % kept} * width]; };
  for (std::uint32_t number = first_row - std::min(first_row, kept - 1); number < end_row;
       ++number) {
    const StarGrid::VoxelRow row = grid_.row(number);
    std::uint32_t* const own = words_of(number);
    for (std::uint32_t x = 0; x < width; ++x) own[x] = word_of(row.first + x);
    if (number < first_row) continue;
    const std::uint32_t z = row.z - (layers - 1), y = row.y - 1;  // the coordinates of the cells
    if (!is_inner(1, y) || (has_cubes() && !is_inner(0, z))) continue;
    std::array<const std::uint32_t*, 4> voxels{};  // indexed by bits 0 and 1 of u
    for (std::uint32_t zy = 0; zy < 4; ++zy)
      if ((zy & 1U) < layers)
        voxels[zy] = words_of(number - (layers - 1 - (zy & 1U)) * height - (1 - (zy >> 1U)));
    const auto said_by = [&](std::uint32_t x, std::uint32_t zy) {
      return (voxels[zy][x] & 7U << 3 * zy) | (voxels[zy][x + 1] & 7U << 3 * (zy | 4U));
    };
    std::uint32_t node = (z + border_[0]) * stride_[0] + (y + border_[1]) * stride_[1] + stride_[2];
    for (std::uint32_t x = 1 - border_[2]; is_inner(2, x); ++x, node += stride_[2]) {
      std::uint32_t said = said_by(x, 0) | said_by(x, 2);
      if (layers == 2) said |= said_by(x, 1) | said_by(x, 3);
      if (said != 0) use(node, node + offset[static_cast<std::size_t>(std::countr_zero(said))]);
    }
  }
}

template <class Directions, class ExitOf>
std::uint32_t TopGraph::arrow_word(unsigned cells, const Directions& directions, ExitOf&& exit_of) {
  std::uint32_t word = 0;
  for (; cells != 0; cells &= cells - 1) {
    const int n = std::countr_zero(cells);
    const Direction d = directions[static_cast<std::size_t>(n)];
    const unsigned u = (d[0] < 0 ? 1U : 0U) | (d[1] < 0 ? 2U : 0U) | (d[2] < 0 ? 4U : 0U);
    word |= 1U << (3 * u + static_cast<unsigned>(exit_of(n)));
  }
  return word;
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
    tables.square_order().for_each(tables.critical_squares(star, {}), use_cell);
  else if (StarTables::cubes(star) == 255)
    tables.cube_order().for_each(grid_.pair_cubes(v).critical_cubes(), use_cell);
}

}  // namespace ph::cubical
