// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <bit>
#include <concepts>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "critical_cells.hpp"
#include "free_edges.hpp"
#include "loop_column.hpp"
#include "pair_sink.hpp"
#include "ph/core/parallel.hpp"

namespace ph::cubical {

/// H1 of three axes: boundaries of the critical squares that are left, reduced to critical edges
/// that are left by adding older ones only. Several threads reduce columns at a time; who has an
/// older column's pivot takes it, and the younger column is reduced further in the next round
/// (Morozov & Nigmetov, Towards lockfree persistent homology, 2020). The pairs do not depend on who
/// comes first. One thread that goes from old to young never has to take one away; where stars lie
/// in a file, it goes along the grid instead.
/// @tparam Stars StarGrid, whose stars have their marks, or StoredStars.
template <Field K, class Stars>
class LoopReduction {
 public:
  /// @param squares of which those in the order give birth to nothing.
  LoopReduction(const Stars& grid, const FreeEdges& free, const CriticalCells& squares,
                const K& field, const RunContext& context)
      : grid_(grid),
        free_(free),
        squares_(squares),
        field_(field),
        context_(context),
        owners_(free.count(), kNone, &context.memory),
        columns_(squares.order.size(), &context.memory) {}

  using Chain = LoopColumn<K, Stars>;
  using Term = typename Chain::Term;
  /// The boundary of a square and what was added to it, as far as it was followed.
  struct Column {
    std::optional<Term> pivot;  ///< nothing: it is zero, or was never looked at
    std::span<const Term> below{};
  };

  void run(PairSink& sink) {
    // Threads that come and go would take longer than a few columns do.
    constexpr std::size_t few = 1024;
    reduce_all(columns_.size() < few ? few : kPiece);
    for_each_class([&](const StarCell& edge, const StarCell& square,
                       const Column&) { sink.pair(1, edge, square); },
                   [&](const StarCell& square) { sink.essential(2, square); },
                   [&](const StarCell& edge) { sink.essential(1, edge); });
  }

  /// Reduces by one thread, so that what columns hold does not depend on who came first.
  void reduce_in_order() { reduce_all(std::max<std::size_t>(1, columns_.size())); }
  /// Calls `on_pair(edge, square, column)` for each loop that dies, `on_surface(square)` for each
  /// column that is zero, `on_loop(edge)` for each loop that never dies.
  template <class OnPair, class OnSurface, class OnLoop>
  void for_each_class(OnPair&& on_pair, OnSurface&& on_surface, OnLoop&& on_loop);

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kPiece = 64;  // columns that a thread takes at a time
  static constexpr bool kInFile = !std::same_as<Stars, StarGrid>;

  // @param piece columns that a thread takes at a time.
  void reduce_all(std::size_t piece) {
    std::pmr::vector<std::uint32_t> round(columns_.size(), &context_.memory);
    std::iota(round.begin(), round.end(), 0U);
    while (!round.empty()) {
      if (kInFile) std::ranges::sort(round, {}, [&](auto i) { return squares_.order[i].cell; });
      for_each_piece("loops", round.size(), piece, context_,
                     [&](std::size_t begin, std::size_t end) {
                       Worker& worker = take_worker();
                       for (std::size_t i = begin; i < end; ++i) reduce(round[i], worker);
                       const std::lock_guard lock(mutex_);
                       idle_.push_back(&worker);
                     });
      round.clear();
      for (const auto& worker : workers_) {
        round.insert(round.end(), worker->again.begin(), worker->again.end());
        worker->again.clear();
      }
      std::ranges::sort(round);
    }
  }

  // What a thread has to itself. Terms stay where they are: others read them.
  struct Worker {
    Chain column;
    std::vector<std::pmr::vector<Term>> kept;
    std::vector<std::uint32_t> again;  // lost their pivots

    std::span<const Term> keep(std::span<const Term> terms, std::pmr::memory_resource* memory) {
      constexpr std::size_t block = 1 << 14;
      if (kept.empty() || kept.back().capacity() - kept.back().size() < terms.size())
        kept.emplace_back(memory).reserve(std::max(block, terms.size()));
      auto& into = kept.back();
      into.insert(into.end(), terms.begin(), terms.end());
      return std::span<const Term>(into).last(terms.size());
    }
  };
  Worker& take_worker() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      workers_.emplace_back(new Worker{Chain(grid_, field_, context_), {}, {}});
      return *workers_.back();
    }
    Worker& worker = *idle_.back();
    idle_.pop_back();
    return worker;
  }

  int edge_of(const LoopEdge& edge) const {
    return grid_.tables(edge.voxel()).edge_order().at(edge.rank());
  }
  // Where the column is noted that has its pivot at a free edge.
  std::uint32_t& owner_of(const LoopEdge& edge) {
    return owners_[free_.number(edge.voxel(), edge_of(edge))];
  }

  void reduce(std::uint32_t i, Worker& worker) {
    Chain& column = worker.column;
    Column& own = columns_[i];
    std::optional<Term> pivot = own.pivot;
    if (pivot) {
      column.assign(own.below);
    } else {
      const auto [v, square] = squares_.cells[squares_.order[i].cell];
      column.assign_boundary(v, static_cast<int>(square));
      pivot = column.take_pivot();
    }
    for (; pivot; pivot = column.take_pivot()) {
      const std::atomic_ref owner(owner_of(pivot->cell));
      std::uint32_t other = owner.load(std::memory_order_acquire);
      if (other > i) {
        own = {pivot, worker.keep(column.consolidate(), &context_.memory)};
        while (other > i) {
          if (!owner.compare_exchange_weak(other, i, std::memory_order_acq_rel)) continue;
          if (other != kNone) worker.again.push_back(other);
          return;
        }
        column.assign(own.below);  // an older one came first
      }
      const Column& older = columns_[other];
      column.add(field_.negate(field_.multiply(pivot->coefficient(),
                                               field_.inverse(older.pivot->coefficient()))),
                 older.below);
    }
    own = {};
  }

  const Stars& grid_;
  const FreeEdges& free_;
  const CriticalCells& squares_;
  const K& field_;
  const RunContext& context_;
  std::pmr::vector<std::uint32_t> owners_;  // of free edges: a column
  std::pmr::vector<Column> columns_;        // in the order of the squares
  std::mutex mutex_;                        // for what follows
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<Worker*> idle_;
};

template <Field K, class Stars>
template <class OnPair, class OnSurface, class OnLoop>
void LoopReduction<K, Stars>::for_each_class(OnPair&& on_pair, OnSurface&& on_surface,
                                             OnLoop&& on_loop) {
  Ticker ticker(context_, "bars of loops", columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    ticker.tick();
    const auto [value, cell] = squares_.order[i];
    const StarCell square{squares_.cells[cell].voxel, kSquares[squares_.cells[cell].number], value};
    if (const auto& pivot = columns_[i].pivot) {
      const std::uint32_t v = pivot->cell.voxel();
      on_pair(StarCell{v, kEdges[edge_of(pivot->cell)], pivot->cell.value()}, square, columns_[i]);
    } else {
      on_surface(square);
    }
  }
  // Free edges that nobody has: loops that never die.
  auto owner = owners_.begin();
  free_.for_each([&](std::uint32_t v, unsigned edges) {
    ticker.work();
    for (; edges != 0; edges &= edges - 1, ++owner)
      if (*owner == kNone) on_loop(StarCell{v, kEdges[std::countr_zero(edges)], grid_.value(v)});
  });
}

}  // namespace ph::cubical
