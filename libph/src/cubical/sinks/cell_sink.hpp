// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "libph/src/cubical/grid/cell_grid.hpp"
#include "libph/src/cubical/sinks/bar_blocks.hpp"

namespace ph::cubical {

/// Turns pairs of cells of the grid into bars of the input.
class CellSink {
 public:
  CellSink(const CellGrid& grid, bool wants_cells, const BarSink& bars)
      : grid_(grid), blocks_(grid.loop_count(), wants_cells, bars) {}

  /// Adds a class of dimension `dim` that is born with a cell and killed by a cell one dimension
  /// higher. The class becomes a bar unless both cells have the same value. If no death is given,
  /// the class never dies.
  void add(int dim, CellGrid::Name birth, std::optional<CellGrid::Name> death) {
    const double from = grid_.value(birth), to = death ? grid_.value(*death) : kInfinity;
    if (from == to) return;
    blocks_.add({dim, from, to},
                [&](unsigned loops, std::vector<Index>& of_birth, std::vector<Index>& of_death) {
                  grid_.append_numbers(CellGrid::cell(birth), loops, of_birth);
                  if (death) grid_.append_numbers(CellGrid::cell(*death), loops, of_death);
                });
  }
  /// Passes on the bars that have not been passed on yet.
  void finish() { blocks_.finish(); }

 private:
  const CellGrid& grid_;
  BarBlocks blocks_;
};

}  // namespace ph::cubical
