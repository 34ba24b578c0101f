// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/cubical/bar_sink.hpp"

namespace ph::cubical {

/// Passes bars to a sink. It passes on many bars at a time, or single bars if their cells are
/// wanted. Each bar is passed on together with its copies that go around periodic axes with one
/// voxel.
class BarBlocks {
 public:
  /// @param loop_count the number of periodic axes with one voxel.
  BarBlocks(std::size_t loop_count, bool wants_cells, const BarSink& bars)
      : loop_count_(loop_count), wants_cells_(wants_cells), bars_(bars) {}

  bool wants_cells() const { return wants_cells_; }
  /// @param append_cells called if cells are wanted, with the axes that the copy goes around (as
  /// bits) and two lists. It appends the coordinates of the birth cell to the first list, and the
  /// coordinates of the death cell to the second.
  template <class AppendCells>
  void add(const Bar& bar, AppendCells&& append_cells) {
    for (unsigned loops = 0; loops < 1U << loop_count_; ++loops) {
      const Bar copy{bar.dim + std::popcount(loops), bar.birth, bar.death};
      if (!wants_cells_) {
        block_[held_++] = copy;
        if (held_ == block_.size()) finish();
        continue;
      }
      birth_.clear();
      death_.clear();
      append_cells(loops, birth_, death_);
      bars_.add(copy, birth_, death_);
    }
  }
  /// Passes on the bars that have not been passed on yet.
  void finish() {
    bars_.add_all(std::span(block_).first(held_));
    held_ = 0;
  }

 private:
  std::size_t loop_count_;
  bool wants_cells_;
  const BarSink& bars_;
  std::array<Bar, 256> block_;  // bars without cells that have not been passed on yet
  std::size_t held_ = 0;
  std::vector<Index> birth_, death_;
};

}  // namespace ph::cubical
