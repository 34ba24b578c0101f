// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cell_grid.hpp"
#include "ph/core/barcode.hpp"
#include "ph/cubical/pair_voxels.hpp"

namespace ph::cubical {

/// Turns pairs of a grid's cells into bars of the input.
class CellSink {
 public:
  CellSink(const CellGrid& grid, bool wants_cells, const BarSink& bars)
      : grid_(grid), wants_cells_(wants_cells), bars_(bars) {}

  /// A class of dimension `dim` born with a cell, killed by a cell one dimension higher: a bar
  /// unless both have the same value. Without a death it never dies.
  void add(int dim, CellGrid::Name birth, std::optional<CellGrid::Name> death) {
    const double from = grid_.value(birth), to = death ? grid_.value(*death) : kInfinity;
    if (from == to) return;
    for (unsigned loops = 0; loops < 1U << grid_.loop_count(); ++loops) {
      const Bar bar{dim + std::popcount(loops), from, to};
      if (!wants_cells_) {
        block_[held_++] = bar;
        if (held_ == block_.size()) finish();
        continue;
      }
      birth_numbers_.clear();
      death_numbers_.clear();
      grid_.append_numbers(CellGrid::cell(birth), loops, birth_numbers_);
      if (death) grid_.append_numbers(CellGrid::cell(*death), loops, death_numbers_);
      bars_.add(bar, birth_numbers_, death_numbers_);
    }
  }
  /// Hands over what it still holds.
  void finish() {
    bars_.add_all(std::span(block_).first(held_));
    held_ = 0;
  }

 private:
  const CellGrid& grid_;
  bool wants_cells_;
  const BarSink& bars_;
  std::array<Bar, 256> block_;  // without cells, not yet handed over
  std::size_t held_ = 0;
  std::vector<Index> birth_numbers_, death_numbers_;
};

}  // namespace ph::cubical
