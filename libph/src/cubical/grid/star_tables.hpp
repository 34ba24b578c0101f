// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

namespace ph::cubical {

// The lower star of a voxel v in a grid of at most three axes consists of v and the edges, squares
// and cubes whose youngest voxel is v. Each cell is named by its direction, which is twice the
// offset from v to the centre of the cell, in {-1, 0, 1}^3. A star is stored as one word: bits 0-5
// are the edges, bits 6-17 are the squares, and bits 18-25 are the cubes. Each group is in
// lexicographic order of the directions. The star is a cone over the lower link of v. The lower
// link is a subcomplex of the octahedron: its vertices are the edges of the star, its edges are the
// squares, and its triangles are the cubes.

/// A direction, by axis; the last axis is the fastest.
using Direction = std::array<int, 3>;

constexpr int kEdgeCount = 6, kSquareCount = 12, kCubeCount = 8;
constexpr int kSquareShift = kEdgeCount, kCubeShift = kEdgeCount + kSquareCount;
/// Bits 26-30 mark edges that are known to be in a pair. The oldest edge needs no mark.
constexpr int kTakenShift = kCubeShift + kCubeCount - 1;   // the bit before the first mark
constexpr std::uint32_t kAbsent = std::uint32_t{1} << 31;  ///< the voxel never enters

constexpr int dimension_of(const Direction& d) { return (d[0] != 0) + (d[1] != 0) + (d[2] != 0); }

/// All directions of one dimension in lexicographic order.
template <int count>
constexpr std::array<Direction, count> directions_of(int dim) {
  std::array<Direction, count> all{};
  int next = 0;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (dimension_of({z, y, x}) == dim) all[next++] = {z, y, x};
  return all;
}
inline constexpr auto kEdges = directions_of<kEdgeCount>(1);
inline constexpr auto kSquares = directions_of<kSquareCount>(2);
inline constexpr auto kCubes = directions_of<kCubeCount>(3);

constexpr int place_of(const Direction& d) { return (d[0] + 1) * 9 + (d[1] + 1) * 3 + d[2] + 1; }
/// For each direction, indexed by place_of(direction), the number of the direction among all
/// directions of the same dimension.
inline constexpr std::array<int, 27> kNumbers = [] {
  std::array<int, 27> numbers{};
  for (int i = 0; i < kEdgeCount; ++i) numbers[place_of(kEdges[i])] = i;
  for (int i = 0; i < kSquareCount; ++i) numbers[place_of(kSquares[i])] = i;
  for (int i = 0; i < kCubeCount; ++i) numbers[place_of(kCubes[i])] = i;
  return numbers;
}();
constexpr int number_of(const Direction& d) { return kNumbers[place_of(d)]; }
/// The bit of a direction in a star.
constexpr std::uint32_t star_bit(const Direction& d) {
  const int shift = dimension_of(d) == 1 ? 0 : dimension_of(d) == 2 ? kSquareShift : kCubeShift;
  return std::uint32_t{1} << (shift + number_of(d));
}
/// A direction with the component on one axis replaced.
constexpr Direction turned(Direction d, int axis, int to) {
  d[axis] = to;
  return d;
}
constexpr int axis_of_edge(int edge) {
  return kEdges[edge][0] != 0 ? 0 : kEdges[edge][1] != 0 ? 1 : 2;
}
/// The two edges of a square that have the voxel of the star as an end; the edge along the slower
/// axis comes first.
constexpr std::array<int, 2> edges_of_square(int square) {
  std::array<int, 2> edges{};
  int next = 0;
  for (int a = 0; a < 3; ++a)
    if (const int sign = kSquares[square][a]; sign != 0) {
      Direction d{};
      d[a] = sign;
      edges[next++] = number_of(d);
    }
  return edges;
}
inline constexpr auto kEdgesOfSquare = [] {
  std::array<std::array<int, 2>, kSquareCount> all{};
  for (int s = 0; s < kSquareCount; ++s) all[s] = edges_of_square(s);
  return all;
}();
/// The axis that a square does not span.
constexpr int normal_of_square(int square) {
  return kSquares[square][0] == 0 ? 0 : kSquares[square][1] == 0 ? 1 : 2;
}
/// The square of a cube that touches the voxel of the star and does not span the axis.
constexpr int square_of_cube(int cube, int axis) {
  return number_of(turned(kCubes[cube], axis, 0));
}

/// The numbers of the directions of one dimension, sorted by the order of their cells in the grid.
template <int count>
class GridOrder {
 public:
  /// @param wrapped as in StarTables.
  GridOrder(const std::array<Direction, count>& directions, unsigned wrapped) {
    const auto place = [&](int i) {
      Direction d = directions[i];
      for (int a = 0; a < 3; ++a)
        // Such a direction comes after all other directions along this axis.
        if (d[a] < 0 && (wrapped >> a & 1U) != 0) d[a] = 2;
      return d;
    };
    std::iota(at_.begin(), at_.end(), 0);
    std::ranges::sort(at_, {}, place);
    for (int i = 0; i < count; ++i) rank_[at_[i]] = i;
    is_by_number_ = std::ranges::is_sorted(at_);
  }
  int rank(int number) const { return rank_[number]; }
  int at(int rank) const { return at_[rank]; }
  /// Calls `use(number)` for the bits of a set, in order.
  template <class Use>
  void for_each(unsigned set, Use&& use) const {
    if (is_by_number_ || (set & (set - 1)) == 0) {
      for (; set != 0; set &= set - 1) use(std::countr_zero(set));
      return;
    }
    for (const int number : at_)
      if ((set >> number & 1U) != 0) use(number);
  }

 private:
  std::array<int, count> at_{}, rank_{};
  bool is_by_number_;
};

/// The squares that the cubes of a star are paired with, and the cubes that are not paired, in one
/// word.
class CubePairs {
 public:
  CubePairs() = default;
  explicit CubePairs(std::uint64_t word) : word_(word) {}
  std::uint64_t word() const { return word_; }

  /// The axis along which a path leaves a cube through the square with which the cube is paired.
  int exit(int cube) const { return static_cast<int>(word_ >> (2 * cube) & 3U); }
  /// The squares that are paired with cubes.
  unsigned squares() const { return static_cast<unsigned>(word_ >> 16) & 4095U; }
  /// Cubes that are not paired.
  unsigned critical_cubes() const { return static_cast<unsigned>(word_ >> 28) & 255U; }

  void set_exit(int cube, int axis) { word_ |= static_cast<std::uint64_t>(axis) << (2 * cube); }
  void set_squares(unsigned squares) { word_ |= std::uint64_t{squares} << 16; }
  void set_critical(int cube) { word_ |= std::uint64_t{1} << (28 + cube); }

 private:
  std::uint64_t word_ = 0;
};

/// Tables of the pairs inside stars. These pairs are the persistence pairs of a star modulo its
/// lower link, in the order of the filtration. The pairs decide which cells are killed, which cells
/// kill, and which cells neither kill nor are killed (*critical cells*). Partners are then
/// exchanged, which makes the matching a forest and leaves the critical cells unchanged (see
/// docs/explanation/engines/discrete-gradient.md).
class StarTables {
 public:
  /// @param wrapped bit a is set if the voxel is the first one of the periodic axis a; the cells
  /// before the voxel along a then come last in the grid.
  explicit StarTables(unsigned wrapped);

  struct Closed {
    std::uint32_t star;
    /// Not 0 if the voxel or a cell of the star is critical, that is, not paired inside the star.
    unsigned critical;
  };
  /// Removes squares that lack an edge and cubes that lack a square.
  Closed closed(std::uint32_t raw) const {
    const unsigned e = raw & 63U;
    const OfEdges& of_edges = of_edges_[e];
    const unsigned s = raw >> kSquareShift & of_edges.squares_on;
    const OfSquares& of_squares = of_squares_[s];
    const unsigned c = raw >> kCubeShift & of_squares.cubes_on;
    // Each cube is paired with a square that closes a loop, except for one cube in a full star.
    const unsigned critical = static_cast<unsigned>(e == 0) |
                              (e & ~unsigned{of_squares.joined} & ~unsigned{of_edges.lowest}) |
                              (of_squares.loops ^ kBitCount[c]) | static_cast<unsigned>(c == 255);
    return {e | s << kSquareShift | c << kCubeShift, critical};
  }
  static unsigned edges(std::uint32_t star) { return star & 63U; }
  static unsigned squares(std::uint32_t star) { return star >> kSquareShift & 4095U; }
  static unsigned cubes(std::uint32_t star) { return star >> kCubeShift & 255U; }

  /// The edge with which the voxel is paired, which is the oldest edge. Precondition: the star has
  /// an edge.
  int arrow(std::uint32_t star) const { return arrow_[edges(star)]; }
  /// The edges that are not paired inside the star.
  unsigned critical_edges(std::uint32_t star) const {
    const unsigned e = edges(star);
    return e & ~(of_squares_[squares(star)].joined | 1U << arrow_[e]);
  }
  /// The critical edges that are not marked.
  unsigned free_edges(std::uint32_t star) const {
    unsigned free = critical_edges(star);
    for (unsigned rest = star >> (kTakenShift + 1) & 31U; rest != 0; rest &= rest - 1)
      free &= ~(1U << edge_order_.at(std::countr_zero(rest) + 1));
    return free;
  }
  /// The bit that marks an edge as taken. Precondition: the edge is not the arrow.
  std::uint32_t taken_mark(int edge) const {
    return std::uint32_t{1} << (kTakenShift + edge_order_.rank(edge));
  }
  /// The square that an edge is paired with, or -1.
  int square_of(std::uint32_t star, int edge) const { return up_[squares(star)][edge]; }
  /// The squares of a star that are paired with edges.
  unsigned edge_squares(std::uint32_t star) const { return tree_[squares(star)]; }
  /// The edge that a square is paired with. Precondition: the square is in `edge_squares`.
  int edge_of(std::uint32_t star, int square) const {
    const auto [a, b] = kEdgesOfSquare[square];
    return up_[squares(star)][a] == square ? a : b;
  }
  CubePairs pair_cubes(std::uint32_t star) const;
  /// The index of a star in tables of `pair_cubes`. The index depends on the squares and cubes of
  /// the star, and is less than `cube_place_count`.
  std::uint32_t cube_place(std::uint32_t star) const {
    const unsigned c = cubes(star);
    // The squares determine which cubes are possible. Adds the index of the set of cubes among all
    // subsets of the possible cubes.
    std::uint32_t place = places_begin_[squares(star)];
    int bit = 0;
    for (unsigned rest = of_squares_[squares(star)].cubes_on; rest != 0; rest &= rest - 1, ++bit)
      place += std::uint32_t{(c & rest & (0U - rest)) != 0} << bit;
    return place;
  }
  std::uint32_t cube_place_count() const { return place_count_; }
  /// The squares that are not paired inside the star.
  unsigned critical_squares(std::uint32_t star, const CubePairs& pairs) const {
    return squares(star) & ~(tree_[squares(star)] | pairs.squares());
  }

  const GridOrder<kEdgeCount>& edge_order() const { return edge_order_; }
  const GridOrder<kSquareCount>& square_order() const { return square_order_; }
  const GridOrder<kCubeCount>& cube_order() const { return cube_order_; }

 private:
  static constexpr auto kBitCount = [] {
    std::array<std::uint8_t, 256> counts{};
    for (unsigned i = 1; i < 256; ++i)
      counts[i] = static_cast<std::uint8_t>(counts[i / 2] + (i & 1U));
    return counts;
  }();

  void pair_edges(unsigned squares);

  GridOrder<kEdgeCount> edge_order_;
  GridOrder<kSquareCount> square_order_;
  GridOrder<kCubeCount> cube_order_;
  std::array<std::uint8_t, 64> arrow_{};
  // These data are needed for each voxel, and are therefore side by side in memory.
  struct OfEdges {
    std::uint16_t squares_on;  // the squares whose two edges are both in the set
    std::uint8_t lowest;       // the oldest edge, as a bit
  };
  struct OfSquares {
    std::uint8_t cubes_on;  // the cubes whose three squares are all in the set
    std::uint8_t joined;    // the edges paired with a square of the set
    std::uint8_t loops;     // the number of squares of the set that are not paired with an edge
  };
  std::array<OfEdges, 64> of_edges_{};
  std::array<OfSquares, 4096> of_squares_{};
  // For each set of squares, the squares of the set that are paired with an edge.
  std::array<std::uint16_t, 4096> tree_{};
  std::array<std::array<std::int8_t, kEdgeCount>, 4096> up_{};
  std::array<std::uint32_t, 4096> places_begin_{};  // indexed by set of squares
  std::uint32_t place_count_ = 0;
};

/// The tables for a value of `wrapped`. They are made once, on first use.
const StarTables& star_tables(unsigned wrapped);

/// Caches the results of `StarTables::pair_cubes`, which is slow. Results are computed on first
/// use, because most kinds of stars never occur. Several threads may use the cache.
class CubePairMemo {
 public:
  /// @param is_used false if the memo will never be used; it then allocates no memory.
  CubePairMemo(const StarTables& tables, bool is_used, std::pmr::memory_resource* memory)
      : tables_(&tables), words_(is_used ? tables.cube_place_count() : 0, memory) {}
  CubePairs pair_cubes(std::uint32_t star) const {
    if (StarTables::cubes(star) == 0) return {};
    std::atomic<std::uint64_t>& kept = words_[tables_->cube_place(star)];
    std::uint64_t word = kept.load(std::memory_order_relaxed);
    if (word == 0) kept.store(word = tables_->pair_cubes(star).word(), std::memory_order_relaxed);
    return CubePairs(word);
  }

 private:
  const StarTables* tables_;
  // A word is 0 until the result is found.
  mutable std::pmr::vector<std::atomic<std::uint64_t>> words_;
};

}  // namespace ph::cubical
