// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include "libph/src/cubical/grid/grid_shape.hpp"
#include "libph/src/cubical/sinks/bar_blocks.hpp"

namespace ph::cubical {

/// Turns pairs of cells of the stars' grid into bars of the input.
class PairSink {
 public:
  PairSink(const GridShape& grid, bool wants_cells, const BarSink& bars)
      : grid_(grid), bars_(bars), blocks_(grid.loop_count(), wants_cells, bars) {}

  /// If false, the caller of `pair` need only set the values of cells.
  bool wants_cells() const { return blocks_.wants_cells(); }
  /// Lets the receiver reserve memory for about `count` more pairs.
  void expect(std::size_t count) const { bars_.expect(count); }
  /// Adds a class of dimension `dim` that is born with a cell and killed by a cell one dimension
  /// higher. The class becomes a bar unless both cells have the same value.
  /// @tparam Cell has the members of StarCell; its voxel may have 32 or 64 bits.
  template <class Cell>
  void pair(int dim, const Cell& birth, const Cell& death) {
    if (birth.value == death.value) return;
    if (grid_.is_t_construction())  // here birth and death swap roles
      add({grid_.top_dim() - dim - 1, value(death), value(birth)}, death, &birth);
    else
      add({dim, value(birth), value(death)}, birth, &death);
  }
  /// Adds a class that never dies.
  template <class Cell>
  void essential(int dim, const Cell& birth) {
    add({grid_.is_t_construction() ? grid_.top_dim() - dim : dim, value(birth), kInfinity}, birth,
        static_cast<const Cell*>(nullptr));
  }
  /// Passes on the bars that have not been passed on yet.
  void finish() { blocks_.finish(); }

 private:
  template <class Cell>
  double value(const Cell& cell) const {
    return (grid_.is_t_construction() ? -cell.value : cell.value) + 0.0;
  }
  template <class Cell>
  void add(const Bar& bar, const Cell& birth, const Cell* death) {
    blocks_.add(bar,
                [&](unsigned loops, std::vector<Index>& of_birth, std::vector<Index>& of_death) {
                  const auto append = [&](const Cell& cell, std::vector<Index>& numbers) {
                    grid_.append_numbers(cell.voxel, cell.direction, loops, numbers);
                  };
                  append(birth, of_birth);
                  if (death != nullptr) append(*death, of_death);
                });
  }

  const GridShape& grid_;
  const BarSink& bars_;
  BarBlocks blocks_;
};

}  // namespace ph::cubical
