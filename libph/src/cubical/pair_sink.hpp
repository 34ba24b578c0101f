// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include "cubical/bar_blocks.hpp"
#include "cubical/stars/grid_frame.hpp"

namespace ph::cubical {

/// Turns pairs of the stars' grid into bars of the input.
class PairSink {
 public:
  PairSink(const GridFrame& grid, bool wants_cells, const BarSink& bars)
      : grid_(grid), bars_(bars), blocks_(grid.loop_count(), wants_cells, bars) {}

  /// Else cells need a value only.
  bool wants_cells() const { return blocks_.wants_cells(); }
  /// Says that so many pairs may come next.
  void expect(std::size_t count) const { bars_.expect(count); }
  /// A class of dimension `dim` born with a cell, killed by a cell one dimension higher: a bar
  /// unless both have the same value.
  void pair(int dim, const StarCell& birth, const StarCell& death) {
    if (birth.value == death.value) return;
    if (grid_.is_t_construction())  // turned around
      add({grid_.top_dim() - dim - 1, value(death), value(birth)}, death, &birth);
    else
      add({dim, value(birth), value(death)}, birth, &death);
  }
  /// A class that never dies.
  void essential(int dim, const StarCell& birth) {
    add({grid_.is_t_construction() ? grid_.top_dim() - dim : dim, value(birth), kInfinity}, birth,
        nullptr);
  }
  /// Hands over what it still holds.
  void finish() { blocks_.finish(); }

 private:
  double value(const StarCell& cell) const {
    return (grid_.is_t_construction() ? -cell.value : cell.value) + 0.0;
  }
  void add(const Bar& bar, const StarCell& birth, const StarCell* death) {
    blocks_.add(bar,
                [&](unsigned loops, std::vector<Index>& of_birth, std::vector<Index>& of_death) {
                  grid_.append_numbers(birth, loops, of_birth);
                  if (death != nullptr) grid_.append_numbers(*death, loops, of_death);
                });
  }

  const GridFrame& grid_;
  const BarSink& bars_;
  BarBlocks blocks_;
};

}  // namespace ph::cubical
