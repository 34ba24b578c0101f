// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/stars/free_edges.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// A cell, given by the voxel whose star contains it and by the number of its direction in that
/// star.
struct NumberedCell {
  std::uint32_t voxel, number;
};

/// The cells of one dimension that are not paired inside their stars.
struct CriticalCells {
  struct Place {
    double value;        ///< as stars compare it: negated in the T-construction
    std::uint32_t cell;  ///< index into `cells`
  };
  std::pmr::vector<NumberedCell> cells;  ///< in the order of the grid
  std::pmr::vector<Place> order;         ///< cells in no pair yet, by (value, place in the grid)

  explicit CriticalCells(std::pmr::memory_resource* memory) : cells(memory), order(memory) {}
};

/// Fills `order` with all cells and sorts it. @tparam Grid has the values of voxels.
template <class Grid>
void put_in_order(CriticalCells& critical, const Grid& grid, const RunContext& context) {
  critical.order.resize(critical.cells.size());
  for (std::uint32_t i = 0; i < critical.cells.size(); ++i)
    critical.order[i] = {grid.value(critical.cells[i].voxel), i};
  radix_sort_by_value(
      critical.order, [](const CriticalCells::Place& place) { return place.value; }, context);
}

/// Lists the critical cells of a dimension, which must be 1 or 2, and puts them in order.
CriticalCells critical_cells(const StarGrid& grid, int dim, const RunContext& context);
/// Marks, in stars of three axes, the critical edges that are no longer in `edges.order`.
void mark_paired(StarGrid& grid, const CriticalCells& edges);
/// Marks the critical edges that are not free, in the stars of the voxels from `begin` up to `end`.
void mark_all_but(StarGrid& grid, const FreeEdges& free, std::uint32_t begin, std::uint32_t end);
/// The free edges of a grid in which all other critical edges are marked.
FreeEdges free_edges(const StarGrid& grid, const RunContext& context);

}  // namespace ph::cubical
