// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/components/cell_map.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/core/polled_sort.hpp"
#include "ph/detail/reduction/apparent_pairs.hpp"
#include "ph/detail/reduction/coboundary_column.hpp"
#include "ph/detail/reduction/pivot_table.hpp"
#include "ph/error.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Reduces coboundary columns, one dimension after the other, youngest first, with clearing (Chen &
/// Kerber, Persistent homology computation with a twist): a cell found as a pivot needs no column
/// of its own in the next dimension. A column to which other columns were added is kept as the
/// cochain whose coboundary it is (a cocycle until the death), because coboundaries are far longer
/// than the cochains.
///
/// Several threads reduce columns at the same time, see PivotTable. The pairs do not depend on the
/// number of threads: every reduction that adds younger columns to older ones has the same outcome.
/// The cochains may depend on that number; if cocycles are requested, only one thread works.
template <CofacetFiltration F, Field K>
class CohomologyReduction {
 public:
  using Cell = typename F::Cell;

  /// How threads share the columns; it does not change the pairs.
  struct Schedule {
    std::size_t piece = 32;  ///< columns per thread at a time: few, because old columns are long
    /// The worst order: each column is reduced before the columns it needs.
    bool oldest_first = false;
  };
  CohomologyReduction(const F& filtration, const K& field, BarcodeBuilder<F>& bars,
                      const RunContext& context)
      : CohomologyReduction(filtration, field, bars, context, Schedule()) {}
  CohomologyReduction(const F& filtration, const K& field, BarcodeBuilder<F>& bars,
                      const RunContext& context, Schedule schedule)
      : f_(filtration),
        field_(field),
        bars_(bars),
        context_(context),
        apparent_(filtration, field),
        cleared_(filtration, &context.memory),
        death_cells_(&context.memory),
        essential_(&context.memory),
        to_reduce_(&context.memory),
        schedule_(schedule),
        gives_cocycles_(bars.representatives() == Representatives::cocycles) {}

  /// Reduces all columns of dimension `dim`. Call with ascending dimensions.
  void reduce_dimension(int dim) {
    dim_ = dim;
    death_cells_.clear();
    essential_.clear();
    to_reduce_.clear();
    collect_columns();
    if (to_reduce_.size() >= PivotTable<F, K>::kNone)
      throw Error(ErrorKind::resource,
                  "cohomology: found more than 2^32 - 2 columns of one dimension");
    pivots_.emplace(f_, to_reduce_.size(), &context_.memory);
    if (gives_cocycles_)
      reduce_one_by_one();
    else
      reduce_side_by_side();
    report_pairs();
    pivots_.reset();
    workers_.clear();
  }
  /// The cells of dimension dim + 1 that killed a class of the dimension reduced last (cells of
  /// apparent pairs only if bars of length zero are wanted), and the births of its infinite bars.
  std::span<const Cell> death_cells() const { return death_cells_; }
  std::span<const Cell> essential() const { return essential_; }

  /// Sets the pivots of the previous dimension, if another engine reduced that dimension. Call it
  /// before the first call to `reduce_dimension`.
  void set_cleared(CellMap<F> pivots) { cleared_ = std::move(pivots); }

 private:
  using Term = Entry<Cell, K>;
  using Column = ReducedColumn<Cell, K>;
  static constexpr std::size_t kPollInterval = 4096;  // steps

  /// The working memory of one thread. Columns that a worker published stay valid as long as the
  /// worker exists.
  struct Worker {
    Worker(const F& f, const K& field, const RunContext& context)
        : working(f, field, context), arena(&context.memory) {}

    CoboundaryColumn<F, K> working;
    std::pmr::monotonic_buffer_resource arena;
  };

  void collect_columns();
  void collect_unmatched();
  void reduce_one_by_one();
  void reduce_side_by_side();
  void report_pairs();

  /// Reduces column `number`, and each column that is driven out of its pivot on the way, see
  /// PivotTable.
  void reduce(std::uint32_t number, Worker& worker);
  /// Fills the working column with the coboundary of the column's cell alone. @return true if the
  /// pivot was found on the way, as an emergent pair (Bauer, Ripser, section 3.5); the working
  /// column is then unfinished.
  bool start_column(std::uint32_t number, Worker& worker, Term& pivot) const;
  /// Cancels the pivot with another column that has the same pivot. @return true if there is such a
  /// column.
  bool cancel_pivot(std::uint32_t number, const Term& pivot, Worker& worker) const;
  /// A permanent copy of the chain, with the pivot if there is one.
  const Column* keep(const Term* pivot, Worker& worker) const;
  void give_cocycle(const Cell& cell, std::span<const Term> chain);

  const F& f_;
  const K& field_;
  BarcodeBuilder<F>& bars_;
  const RunContext& context_;
  ApparentPairs<F, K> apparent_;
  int dim_ = 0;
  CellMap<F> cleared_;  // pivots of the dimension before
  std::pmr::vector<Cell> death_cells_, essential_;
  std::pmr::vector<Cell> to_reduce_;  // youngest first; a column's number is its position
  std::optional<PivotTable<F, K>> pivots_;
  std::vector<std::unique_ptr<Worker>> workers_;
  Schedule schedule_;
  bool gives_cocycles_;
};

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::collect_columns() {
  if constexpr (ApparentFiltration<F>) {
    if (dim_ > 0 && !bars_.wants_zero_length()) {
      collect_unmatched();
      return;
    }
  }
  Ticker ticker(context_, "columns");
  f_.for_each_cell(dim_, [&](const Cell& cell) {
    ticker.tick();
    if (cleared_.find(cell) != CellMap<F>::kAbsent) return;
    if (apparent_.birth_cell_of(dim_, cell)) return;  // a pivot of the dimension below
    if (const auto death = apparent_.death_cell_of(dim_, cell)) {
      if (!bars_.wants_zero_length()) return;
      death_cells_.push_back(*death);
      if (bars_.add_pair(dim_, cell, *death)) give_cocycle(cell, {});
      return;
    }
    to_reduce_.push_back(cell);
  });
  const auto is_younger = [&](const Cell& a, const Cell& b) { return f_.precedes(b, a); };
  polled_sort(to_reduce_, is_younger, ticker);
}

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::collect_unmatched() {
  // Groups are taken in reverse order. Each piece stores its findings at a place of its own, which
  // makes the order independent of the threads.
  constexpr std::size_t piece = 256;
  const std::size_t groups = f_.group_count();
  using Finder = decltype(f_.unmatched_cells(dim_));
  std::mutex mutex;
  std::vector<std::unique_ptr<Finder>> idle;
  std::vector<std::pmr::vector<Cell>> found;
  for (std::size_t i = 0; i < groups; i += piece) found.emplace_back(&context_.memory);
  for_each_piece("columns", groups, piece, context_, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<Finder> cells;
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        cells = std::move(idle.back());
        idle.pop_back();
      }
    }
    if (!cells) cells = std::make_unique<Finder>(f_.unmatched_cells(dim_));
    auto& list = found[begin / piece];
    std::size_t pending = 0;
    cells->for_each(
        groups - end, groups - begin,
        [&](const Cell& cell) {
          if (cleared_.find(cell) == CellMap<F>::kAbsent) list.push_back(cell);
        },
        [&] {
          if (++pending % kPollInterval == 0) context_.poll();
        });
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(cells));
  });
  for (auto& list : found) {
    to_reduce_.insert(to_reduce_.end(), list.begin(), list.end());
    list = std::pmr::vector<Cell>(&context_.memory);
  }
}

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::reduce_one_by_one() {
  workers_.push_back(std::make_unique<Worker>(f_, field_, context_));
  Ticker ticker(context_, "cohomology", to_reduce_.size());
  for (std::uint32_t i = 0; i < to_reduce_.size(); ++i) {
    reduce(i, *workers_.front());
    ticker.tick();
  }
}

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::reduce_side_by_side() {
  std::mutex mutex;
  std::vector<Worker*> idle;
  for_each_piece("cohomology", to_reduce_.size(), schedule_.piece, context_,
                 [&](std::size_t begin, std::size_t end) {
                   Worker* worker = nullptr;
                   {
                     const std::lock_guard lock(mutex);
                     if (idle.empty()) {
                       workers_.push_back(std::make_unique<Worker>(f_, field_, context_));
                       idle.push_back(workers_.back().get());
                     }
                     worker = idle.back();
                     idle.pop_back();
                   }
                   for (std::size_t i = begin; i < end; ++i) {
                     const std::size_t number =
                         schedule_.oldest_first ? to_reduce_.size() - 1 - i : i;
                     reduce(static_cast<std::uint32_t>(number), *worker);
                   }
                   const std::lock_guard lock(mutex);
                   idle.push_back(worker);
                 });
}

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::report_pairs() {
  cleared_ = CellMap<F>(f_, &context_.memory);
  for (std::uint32_t i = 0; i < to_reduce_.size(); ++i) {
    const Cell& cell = to_reduce_[i];
    const Column* column = pivots_->column(i);
    bool is_kept;
    if (column && !field_.is_zero(column->coefficient)) {
      death_cells_.push_back(column->pivot);
      cleared_.insert(column->pivot, 0);  // mutant: cohomology-clearing
      is_kept = bars_.add_pair(dim_, cell, column->pivot);
    } else {
      essential_.push_back(cell);
      is_kept = bars_.add_essential(dim_, cell);
    }
    if (is_kept) give_cocycle(cell, column ? column->chain : std::span<const Term>());
  }
}

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::give_cocycle(const Cell& cell, std::span<const Term> chain) {
  if (!gives_cocycles_) return;
  std::pmr::vector<Term> terms(&context_.memory);
  terms.emplace_back(cell, field_.from_int(1));
  terms.insert(terms.end(), chain.begin(), chain.end());
  bars_.add_representative(dim_, terms, field_);
}

template <CofacetFiltration F, Field K>
bool CohomologyReduction<F, K>::start_column(std::uint32_t number, Worker& worker,
                                             Term& pivot) const {
  const Cell& cell = to_reduce_[number];
  bool found = false, looks_for_pivot = F::first_equal_cofacet_is_oldest;
  worker.working.start(dim_, cell, [&](const Cell& cofacet, typename K::Element a) {
    if (looks_for_pivot && f_.key(cofacet) == f_.key(cell)) {
      looks_for_pivot = false;
      // mutant: emergent-apparent
      found = pivots_->owner_of(cofacet).number >= number &&
              !apparent_.birth_cell_of(dim_ + 1, cofacet);
      if (found) pivot = Term(cofacet, a);
    }
    return !found;
  });
  return found;
}

template <CofacetFiltration F, Field K>
bool CohomologyReduction<F, K>::cancel_pivot(std::uint32_t number, const Term& pivot,
                                             Worker& worker) const {
  const auto cancel = [&](const Cell& cell, std::span<const Term> chain, typename K::Element a) {
    const auto scale = field_.negate(field_.multiply(pivot.coefficient(), field_.inverse(a)));
    worker.working.add(pivot, cell, chain, scale);
    return true;
  };
  const auto owner = pivots_->owner_of(pivot.cell);
  if (owner.number < number)
    return cancel(to_reduce_[owner.number], owner.column->chain, owner.column->coefficient);
  if (owner.column) return false;  // a column that must give way
  const std::optional<Cell> partner = apparent_.birth_cell_of(dim_ + 1, pivot.cell);
  if (!partner) return false;
  auto a = field_.from_int(1);
  if constexpr (!std::same_as<K, Z2>) {
    f_.for_each_cofacet(dim_, *partner, [&](const Cell& cofacet, int incidence) {
      if (cofacet == pivot.cell) a = field_.from_int(incidence);
      return !(cofacet == pivot.cell);
    });
  }
  return cancel(*partner, {}, a);
}

template <CofacetFiltration F, Field K>
auto CohomologyReduction<F, K>::keep(const Term* pivot, Worker& worker) const -> const Column* {
  const std::span<const Term> added = worker.working.chain();
  std::pmr::polymorphic_allocator<> arena(&worker.arena);
  const std::size_t size = added.size();
  Term* const chain = size == 0 ? nullptr : arena.allocate_object<Term>(size);
  std::uninitialized_copy(added.begin(), added.end(), chain);
  return arena.new_object<Column>(pivot ? Column{pivot->cell, pivot->coefficient(), {chain, size}}
                                        : Column{{}, field_.from_int(0), {chain, size}});
}

template <CofacetFiltration F, Field K>
void CohomologyReduction<F, K>::reduce(std::uint32_t number, Worker& worker) {
  Term pivot;
  bool is_new = start_column(number, worker, pivot);
  for (;;) {
    if (!is_new) {
      if (!worker.working.pop_pivot(pivot)) break;
      if (cancel_pivot(number, pivot, worker)) continue;
    }
    is_new = false;
    const Column* column = keep(&pivot, worker);
    const std::uint32_t other = pivots_->claim(number, column);
    if (other == PivotTable<F, K>::kNone) return;  // mutant: column-driven-out
    if (other != number) {
      number = other;
      column = pivots_->column(number);
    }
    worker.working.start(dim_, to_reduce_[number], column->chain, column->pivot);
  }
  // Nothing is left: the column has no pivot, and its previous publication is no longer valid.
  pivots_->publish(number, gives_cocycles_ ? keep(nullptr, worker) : nullptr);
}

}  // namespace ph
