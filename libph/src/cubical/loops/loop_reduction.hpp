// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/cubical/columns/parallel_reduction.hpp"
#include "libph/src/cubical/loops/loop_column.hpp"
#include "libph/src/cubical/loops/loop_owners.hpp"
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"

namespace ph::cubical {

/// Computes H1 for three axes. The class reduces the boundaries of the critical squares that are
/// not paired yet. The results are chains of the critical edges that are not paired yet. See
/// ParallelReduction. If the stars are in a file that does not stay in memory, columns are
/// processed in the order of the grid instead of from old to young.
/// @tparam Stars StarGrid, in which edges that kill a component are marked, or StoredStars.
template <Field K, class Stars>
class LoopReduction {
  using Chain = LoopColumn<K, Stars>;
  using Reduction = ParallelReduction<K, Chain>;

 public:
  using Term = typename Reduction::Term;
  using Column = typename Reduction::Column;

  /// @param squares the critical squares; the squares listed in `squares.order` give birth to no
  /// class that dies.
  LoopReduction(const Stars& grid, const FreeEdges& free, const CriticalCells& squares,
                const K& field, const RunContext& context)
      : grid_(grid),
        squares_(squares),
        field_(field),
        context_(context),
        owners_(grid, free, context),
        reduction_(squares.order.size(), field, context) {}

  void run(PairSink& sink) {
    // Starting threads would take longer than reducing a few columns.
    constexpr std::size_t few = 1024, piece = 64;
    reduce_all(squares_.order.size() < few ? few : piece, false);
    for_each_class([&](const StarCell& edge, const StarCell& square, const Term&,
                       std::span<const Term>) { sink.pair(1, edge, square); },
                   [&](const StarCell& square) { sink.essential(2, square); },
                   [&](const StarCell& edge) { sink.essential(1, edge); });
  }

  /// Reduces on one thread, which makes the cycles independent of thread order.
  void reduce_to_cycles() { reduce_all(std::max<std::size_t>(1, squares_.order.size()), true); }
  /// Calls `on_pair(edge, square, pivot, rest of the cycle)` for each loop that dies,
  /// `on_surface(square)` for each column that is reduced to zero, and `on_loop(edge)` for each
  /// loop that never dies.
  template <class OnPair, class OnSurface, class OnLoop>
  void for_each_class(OnPair&& on_pair, OnSurface&& on_surface, OnLoop&& on_loop);

 private:
  static constexpr bool kInFile = !std::same_as<Stars, StarGrid>;

  // Reduces the columns. @param piece the number of columns that a thread takes at a time.
  void reduce_all(std::size_t piece, bool to_cycles) {
    reduction_.run(
        "loops", piece, [&] { return Chain(grid_, field_, context_, to_cycles); },
        [&](Chain& column, std::uint32_t i) {
          const auto [v, square] = squares_.cells[squares_.order[i].cell];
          column.assign_boundary(v, static_cast<int>(square));
        },
        [&](const LoopEdge& pivot) -> const Column*& { return owners_.of(pivot); },
        [&](const LoopEdge& pivot) { owners_.expect(pivot); },
        [&](std::span<std::uint32_t> round) {
          if constexpr (kInFile)
            if (!grid_.all_stay())
              std::ranges::sort(round, {}, [&](auto i) { return squares_.order[i].cell; });
        });
  }
  const Stars& grid_;
  const CriticalCells& squares_;
  const K& field_;
  const RunContext& context_;
  LoopOwners<Stars, Column> owners_;
  Reduction reduction_;  // columns in the order of the squares
};

template <Field K, class Stars>
template <class OnPair, class OnSurface, class OnLoop>
void LoopReduction<K, Stars>::for_each_class(OnPair&& on_pair, OnSurface&& on_surface,
                                             OnLoop&& on_loop) {
  const auto columns = reduction_.columns();
  Ticker ticker(context_, "bars of loops", columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    ticker.tick();
    const auto [value, cell] = squares_.order[i];
    const StarCell square{squares_.cells[cell].voxel, kSquares[squares_.cells[cell].number], value};
    if (const Column* const column = columns[i]) {
      on_pair(owners_.cell(column->pivot().cell), square, column->pivot(), column->below());
    } else {
      on_surface(square);
    }
  }
  // Free edges without a column are loops that never die.
  owners_.for_each([&](const StarCell& edge, const Column* owner) {
    ticker.work();
    if (owner == nullptr) on_loop(edge);
  });
}

}  // namespace ph::cubical
