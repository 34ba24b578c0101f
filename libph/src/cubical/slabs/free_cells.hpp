// SPDX-License-Identifier: MIT
#pragma once
#include <compare>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/layers/star_numbers.hpp"

namespace ph::cubical {

/// A cell of the entire grid, given by a voxel and the number of its direction in the voxel's star.
class GridCell {
  static constexpr unsigned kBits = 13;  // a star of eight axes has 3^8 cells

 public:
  /// The largest number of voxels of a grid whose cells have distinct numbers.
  static constexpr std::uint64_t kMostVoxels = std::uint64_t{1} << (64 - kBits);

  GridCell() = default;
  GridCell(std::uint64_t voxel, std::uint32_t number) : both_(voxel << kBits | number) {}
  std::uint64_t voxel() const { return both_ >> kBits; }
  std::uint32_t number() const { return static_cast<std::uint32_t>(both_ & ((1U << kBits) - 1)); }
  friend auto operator<=>(const GridCell&, const GridCell&) = default;

 private:
  std::uint64_t both_ = 0;
};

/// Like StarCell, but with the number of the voxel in the entire grid.
struct WholeCell {
  std::uint64_t voxel;
  WideDirection direction;
  double value;
};

/// Receives the critical edges and squares of three axes that neither graph pairs. Each cell is
/// received once, as soon as it is known that neither graph pairs it. The reduction for loops needs
/// only these cells.
class FreeCellSink {
 public:
  virtual ~FreeCellSink() = default;
  virtual void add_edge(const GridCell& edge) = 0;
  /// Receives a square. @param value the value of the square in the order of the stars.
  virtual void add_square(double value, const GridCell& square) = 0;
};

/// Stores the cells that it receives.
struct FreeCells final : FreeCellSink {
  explicit FreeCells(std::pmr::memory_resource* memory) : edges(memory), squares(memory) {}
  void add_edge(const GridCell& edge) override { edges.push_back(edge); }
  void add_square(double, const GridCell& square) override { squares.push_back(square); }
  void add(const FreeCells& others) {
    edges.insert(edges.end(), others.edges.begin(), others.edges.end());
    squares.insert(squares.end(), others.squares.begin(), others.squares.end());
  }

  std::pmr::vector<GridCell> edges, squares;
};

}  // namespace ph::cubical
