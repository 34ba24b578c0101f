// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "ph/cubical/pair_voxels.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// Turns pairs of the stars' grid into bars of the input.
class PairSink {
 public:
  PairSink(const StarGrid& grid, bool wants_cells, const BarSink& bars)
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
    if (!wants_cells_ && !grid_.has_loops()) return hold(bar);
    grid_.for_each_copy(birth, death, wants_cells_, [&](const auto& a, const auto& b, int shift) {
      const Bar copy{bar.dim + shift, bar.birth, bar.death};
      if (wants_cells_)
        bars_.add(copy, a, b);
      else
        hold(copy);
    });
  }
  void hold(const Bar& bar) {
    block_[held_++] = bar;
    if (held_ == block_.size()) finish();
  }

  const StarGrid& grid_;
  bool wants_cells_;
  const BarSink& bars_;
  std::array<Bar, 256> block_;  // without cells, not yet handed over
  std::size_t held_ = 0;
};

}  // namespace ph::cubical
