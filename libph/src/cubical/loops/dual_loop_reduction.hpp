// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/cubical/columns/parallel_reduction.hpp"
#include "libph/src/cubical/loops/dual_loop_column.hpp"

namespace ph::cubical {

/// Computes H1 of the T-construction for three axes, with cycles, on one thread. See
/// DualLoopColumn.
template <Field K>
class DualLoopReduction {
  using Chain = DualLoopColumn<K>;
  using Reduction = ParallelReduction<K, Chain>;
  using Column = typename Reduction::Column;

 public:
  using Term = typename Reduction::Term;

  /// @param edges,squares critical cells of the stars' grid; the cells listed in `edges.order` and
  /// `squares.order` are not paired by the two graphs.
  DualLoopReduction(const StarGrid& grid, const CriticalCells& edges, const CriticalCells& squares,
                    const K& field, const RunContext& context)
      : grid_(grid),
        edges_(edges),
        squares_(squares),
        free_(grid, squares, &context.memory),
        owners_(squares.cells.size(), nullptr, &context.memory),
        reduction_(edges.order.size(), field, context, 1) {
    reduction_.run(
        "loops", std::max<std::size_t>(1, edges.order.size()),
        [&] { return Chain(grid_, free_, field, context); },
        [&](Chain& column, std::uint32_t i) {
          const auto [v, edge] = edges_.cells[cell_of_column(i)];
          column.assign_boundary(v, static_cast<int>(edge));
        },
        [&](const DualEdge& pivot) -> const Column*& { return owners_[free_.number(pivot)]; },
        [](const DualEdge&) {}, [](std::span<std::uint32_t>) {});
  }

  /// Calls `on_pair(edge, square, pivot, rest of the cycle)` for each loop of T that dies,
  /// `on_surface(edge)` for each column that is reduced to zero, and `on_loop(square)` for each
  /// loop that never dies. Edges and squares are cells of the stars' grid.
  template <class OnPair, class OnSurface, class OnLoop>
  void for_each_class(OnPair&& on_pair, OnSurface&& on_surface, OnLoop&& on_loop) const {
    const auto columns = reduction_.columns();
    for (std::uint32_t i = 0; i < columns.size(); ++i) {
      const NumberedCell& at = edges_.cells[cell_of_column(i)];
      const StarCell edge{at.voxel, kEdges[at.number], edges_.order[columns.size() - 1 - i].value};
      if (const Column* const column = columns[i])
        on_pair(edge, cell(column->pivot().cell), column->pivot(), column->below());
      else
        on_surface(edge);
    }
    for (const auto& [value, cell] : squares_.order)
      if (owners_[cell] == nullptr)
        on_loop(StarCell{squares_.cells[cell].voxel, kSquares[squares_.cells[cell].number], value});
  }
  StarCell cell(const DualEdge& square) const {
    const std::uint32_t v = grid_.here(square.voxel());
    return {v, kSquares[grid_.tables(v).square_order().at(square.rank())], grid_.value(v)};
  }

 private:
  // The oldest square of T, which is the youngest edge of the stars' grid, is the first column.
  std::uint32_t cell_of_column(std::uint32_t i) const {
    return edges_.order[edges_.order.size() - 1 - i].cell;
  }

  const StarGrid& grid_;
  const CriticalCells &edges_, &squares_;
  const FreeDualEdges free_;
  std::pmr::vector<const Column*> owners_;  // indexed by critical square
  Reduction reduction_;
};

}  // namespace ph::cubical
