// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "boundary_column.hpp"
#include "cell_sink.hpp"
#include "ph/core/parallel.hpp"

namespace ph::cubical {

/// Homology between the two ends: boundaries of cells of one dimension, reduced by adding older
/// ones only. Several threads reduce columns at a time; who has an older column's pivot takes it,
/// and the younger column is reduced further in the next round (Morozov & Nigmetov, Towards
/// lockfree persistent homology, 2020). The pairs do not depend on who comes first, and one thread
/// never has to take one away.
template <Field K>
class BoundaryReduction {
 public:
  using Name = CellGrid::Name;

  /// @param columns cells in no known pair, in the order of the filtration.
  /// @param rows those one dimension lower.
  BoundaryReduction(const CellGrid& grid, std::span<const Name> columns, std::span<const Name> rows,
                    const K& field, const RunContext& context)
      : grid_(grid),
        names_(columns),
        field_(field),
        context_(context),
        rows_(std::bit_ceil(2 * rows.size() + 1), Row{}, &context.memory),
        columns_(columns.size(), &context.memory) {
    enter_rows(rows);
  }

  /// @param on_pair called with (column, row), or (column, nothing) if the column is zero.
  template <class OnPair>
  void run(OnPair&& on_pair) {
    std::pmr::vector<std::uint32_t> round(columns_.size(), &context_.memory);
    std::iota(round.begin(), round.end(), 0U);
    while (!round.empty()) {
      for_each_piece("boundaries", round.size(), kPiece, context_,
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
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto& pivot = columns_[i].pivot;
      on_pair(names_[i], pivot ? std::optional<Name>(pivot->cell) : std::nullopt);
    }
  }
  /// Whether a row is a pivot. Precondition: it has run.
  bool is_pivot(Name row) { return owner_of(row) != kNone; }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kPiece = 64;  // columns that a thread takes at a time
  using Term = typename BoundaryColumn<K>::Term;
  struct Row {
    std::uint32_t cell = kNone;
    std::uint32_t owner = kNone;  // a column
  };
  // The boundary of a cell and what was added to it, as far as it was followed.
  struct Column {
    std::optional<Term> pivot;  // nothing: it is zero, or was never looked at
    std::span<const Term> below{};
  };
  // What a thread has to itself. Terms stay where they are: others read them.
  struct Worker {
    BoundaryColumn<K> column;
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
      workers_.push_back(
          std::make_unique<Worker>(Worker{BoundaryColumn<K>(grid_, field_, context_), {}, {}}));
      return *workers_.back();
    }
    Worker& worker = *idle_.back();
    idle_.pop_back();
    return worker;
  }

  void enter_rows(std::span<const Name> rows) {
    Ticker ticker(context_, "rows", rows.size());
    for (const Name name : rows) {
      Row* row = &rows_[start(CellGrid::cell(name))];
      while (row->cell != kNone) row = after(row);
      row->cell = CellGrid::cell(name);
      ticker.tick();
    }
  }
  std::size_t start(std::uint32_t cell) const {
    return (cell * 0x9E3779B97F4A7C15U >> 20) & (rows_.size() - 1);
  }
  template <class Pointer>
  Pointer after(Pointer row) const {
    return row == &rows_.back() ? row - (rows_.size() - 1) : row + 1;
  }
  // Where the column is noted that has its pivot there. Precondition: `row` is one.
  std::uint32_t& owner_of(Name row) {
    Row* found = &rows_[start(CellGrid::cell(row))];
    while (found->cell != CellGrid::cell(row)) found = after(found);
    return found->owner;
  }

  void reduce(std::uint32_t i, Worker& worker) {
    BoundaryColumn<K>& column = worker.column;
    Column& own = columns_[i];
    std::optional<Term> pivot = own.pivot;
    if (pivot) {
      column.assign(own.below);
    } else {
      column.assign_boundary(CellGrid::cell(names_[i]));
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

  const CellGrid& grid_;
  std::span<const Name> names_;  // of the columns
  const K& field_;
  const RunContext& context_;
  std::pmr::vector<Row> rows_;  // a hash table, at most half full
  std::pmr::vector<Column> columns_;
  std::mutex mutex_;  // for what follows
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<Worker*> idle_;
};

}  // namespace ph::cubical
