// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "grid_frame.hpp"
#include "ph/cubical/pair_voxels.hpp"

namespace ph::cubical {

/// Turns pairs of the stars' grid into bars of the input.
class PairSink {
 public:
  PairSink(const GridFrame& grid, bool wants_cells, const BarSink& bars)
      : grid_(grid), wants_cells_(wants_cells), bars_(bars) {}

  /// Else cells need a value only.
  bool wants_cells() const { return wants_cells_; }
  /// Says that so many pairs may come next.
  void expect(std::size_t count) const { bars_.expect(count); }
  /// A class of dimension `dim` born with a cell, killed by a cell one dimension higher: a bar
  /// unless both have the same value.
  void pair(int dim, const StarCell& birth, const StarCell& death) {
    if (birth.value == death.value) return;
    if (grid_.relative())  // turned around
      add({grid_.top_dim() - dim - 1, value(death), value(birth)}, death, &birth);
    else
      add({dim, value(birth), value(death)}, birth, &death);
  }
  /// A class that never dies.
  void essential(int dim, const StarCell& birth) {
    add({grid_.relative() ? grid_.top_dim() - dim : dim, value(birth), kInfinity}, birth, nullptr);
  }
  /// Hands over what it still holds.
  void finish() {
    bars_.add_all(std::span(block_).first(held_));
    held_ = 0;
  }

 private:
  double value(const StarCell& cell) const {
    return (grid_.relative() ? -cell.value : cell.value) + 0.0;
  }
  void add(const Bar& bar, const StarCell& birth, const StarCell* death) {
    for (unsigned loops = 0; loops < 1U << grid_.loop_count(); ++loops) {
      const Bar copy{bar.dim + std::popcount(loops), bar.birth, bar.death};
      if (!wants_cells_) {
        block_[held_++] = copy;
        if (held_ == block_.size()) finish();
        continue;
      }
      birth_numbers_.clear();
      death_numbers_.clear();
      grid_.append_numbers(birth, loops, birth_numbers_);
      if (death != nullptr) grid_.append_numbers(*death, loops, death_numbers_);
      bars_.add(copy, birth_numbers_, death_numbers_);
    }
  }

  const GridFrame& grid_;
  bool wants_cells_;
  const BarSink& bars_;
  std::array<Bar, 256> block_;  // without cells, not yet handed over
  std::size_t held_ = 0;
  std::vector<Index> birth_numbers_, death_numbers_;
};

}  // namespace ph::cubical
