// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/components/cell_map.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/polled_sort.hpp"
#include "ph/detail/reduction/apparent_pairs.hpp"
#include "ph/detail/reduction/working_column.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Reduces boundary columns, one dimension after the other, oldest first, with clearing (Chen &
/// Kerber, Persistent homology computation with a twist): a cell found as a pivot needs no column
/// of its own in the next dimension. A column to which nothing was added is not stored but listed
/// again when needed. Every other column is kept as its reduced boundary. This cycle becomes a
/// boundary at the death, and represents the finite bar. An infinite bar is represented by the
/// chain whose boundary vanished; if representatives are wanted, these chains are kept as well.
template <Filtration F, Field K>
class HomologyReduction {
 public:
  using Cell = typename F::Cell;

  HomologyReduction(const F& filtration, const K& field, BarcodeBuilder<F>& bars,
                    const RunContext& context)
      : f_(filtration),
        field_(field),
        bars_(bars),
        context_(context),
        apparent_(filtration, field),
        pivots_(filtration, &context.memory),
        previous_pivots_(filtration, &context.memory),
        columns_(&context.memory),
        terms_(&context.memory),
        chains_(&context.memory),
        to_reduce_(&context.memory),
        working_(filtration, field, &context.memory),
        rest_(&context.memory),
        chain_(&context.memory),
        tracks_chains_(bars.representatives() != Representatives::none) {}

  /// Reduces all columns of dimension `dim`. Call with descending dimensions.
  void reduce_dimension(int dim) {
    start_dimension(dim);
    collect_columns();
    reduce_collected();
  }
  /// Reduces only these columns of dimension `dim`; dimensions may be reduced in any order. This is
  /// enough if all other columns are zero or apparent, and apparent pairs are not wanted.
  void reduce_columns(int dim, std::span<const Cell> cells) {
    start_dimension(dim);
    for (const Cell& cell : cells) {
      if (const auto birth = apparent_.birth_cell_of(dim, cell))
        report_plain(cell, *birth);
      else
        to_reduce_.push_back(cell);
    }
    reduce_collected();
  }

 private:
  using Term = Entry<Cell, K>;

  void start_dimension(int dim) {
    dim_ = dim;
    columns_.clear();
    terms_.clear();
    chains_.clear();
    to_reduce_.clear();
  }
  void reduce_collected() {
    const auto precedes = [&](const Cell& a, const Cell& b) { return f_.precedes(a, b); };
    Ticker ticker(context_, "homology", to_reduce_.size());
    polled_sort(to_reduce_, precedes, ticker);
    for (const Cell& cell : to_reduce_) {
      reduce_column(cell, ticker);
      ticker.tick();
    }
    previous_pivots_ = std::move(pivots_);       // mutant: homology-clearing
    pivots_ = CellMap<F>(f_, &context_.memory);  // mutant: homology-pivots
  }

  struct Range {
    std::size_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
  };
  struct Column {
    Cell cell;
    typename K::Element pivot{};  // coefficient of the pivot in the reduced boundary
    Range terms;                  // the reduced boundary; if empty, the boundary of `cell` itself
    // The cells that were added to `cell`, without `cell`; only with representatives.
    Range chain;
  };

  void collect_columns();
  void reduce_column(const Cell& cell, Ticker& ticker);
  // Reports the pair of a column to which nothing was added: the column is the boundary of its
  // cell.
  void report_plain(const Cell& column, const Cell& pivot);

  // Adds the multiple of `owner` to the working column that cancels the pivot, which was just
  // popped.
  void cancel_pivot(const Term& pivot, const Column& owner, Ticker& ticker);
  // The column with the pivot `cell`, or null if there is none yet. Valid until the next call.
  const Column* owner_of(const Cell& cell);
  // In dimension 1 the boundary of an edge is the difference of two vertices and stays such a
  // difference under reduction, which makes a heap unnecessary. Both entries are fully reduced,
  // which lets later columns that meet the stored column reach the final vertex in one step.
  void reduce_edge(const Cell& edge, Ticker& ticker);
  // The other entry of a column of two entries.
  Cell other_end(const Column& column, const Cell& pivot) const;
  void finish_column(const Cell& cell, const Term& pivot, bool was_added_to);
  void finish_essential(const Cell& cell);
  // Appends the working chain to chains_, with equal cells added up and without the column's own
  // cell.
  Range store_chain();

  const F& f_;
  const K& field_;
  BarcodeBuilder<F>& bars_;
  const RunContext& context_;
  ApparentPairs<F, K> apparent_;
  int dim_ = 0;
  CellMap<F> pivots_;           // pivot -> position in columns_
  CellMap<F> previous_pivots_;  // pivots of the dimension reduced before
  std::pmr::vector<Column> columns_;
  Column apparent_owner_;
  std::pmr::vector<Term> terms_;   // terms of reduced boundaries
  std::pmr::vector<Term> chains_;  // terms of chains
  std::pmr::vector<Cell> to_reduce_;
  WorkingColumn<F, K, Pivot::youngest> working_;
  std::pmr::vector<Term> rest_;   // entries below the pivot of an edge's boundary
  std::pmr::vector<Term> chain_;  // the columns that were added to the working column
  bool tracks_chains_;
};

template <Filtration F, Field K>
void HomologyReduction<F, K>::collect_columns() {
  Ticker ticker(context_, "columns");
  f_.for_each_cell(dim_, [&](const Cell& cell) {
    ticker.tick();
    if (previous_pivots_.find(cell) != CellMap<F>::kAbsent) return;
    // The cell is a pivot of the dimension above. If that dimension is not wanted, its cells were
    // never listed.
    if (dim_ <= bars_.max_dim() && apparent_.death_cell_of(dim_, cell)) return;
    if (const auto birth = apparent_.birth_cell_of(dim_, cell)) {
      if (bars_.wants_zero_length()) report_plain(cell, *birth);
      return;
    }
    to_reduce_.push_back(cell);
  });
}

template <Filtration F, Field K>
void HomologyReduction<F, K>::cancel_pivot(const Term& pivot, const Column& owner, Ticker& ticker) {
  const auto scale =
      field_.negate(field_.multiply(pivot.coefficient(), field_.inverse(owner.pivot)));
  // The pivot occurs once in the owner's boundary; leaving it out has the same effect as cancelling
  // it.
  if (owner.terms.empty()) {
    f_.for_each_facet(dim_, owner.cell, [&](const Cell& facet, int incidence) {
      if (!(facet == pivot.cell))
        working_.push(facet, field_.multiply(scale, field_.from_int(incidence)));
    });
  }
  for (std::size_t i = owner.terms.begin + 1; i < owner.terms.end; ++i)
    working_.push(terms_[i].cell, field_.multiply(scale, terms_[i].coefficient()));
  ticker.work(owner.terms.end - owner.terms.begin + 1);
  if (!tracks_chains_) return;
  chain_.emplace_back(owner.cell, scale);
  for (std::size_t i = owner.chain.begin; i < owner.chain.end; ++i)
    chain_.emplace_back(chains_[i].cell, field_.multiply(scale, chains_[i].coefficient()));
}

template <Filtration F, Field K>
auto HomologyReduction<F, K>::owner_of(const Cell& cell) -> const Column* {
  if (const auto at = pivots_.find(cell); at != CellMap<F>::kAbsent) return &columns_[at];
  const auto partner = apparent_.death_cell_of(dim_ - 1, cell);
  if (!partner) return nullptr;
  apparent_owner_ = {*partner, field_.from_int(1), {}, {}};
  if constexpr (!std::same_as<K, Z2>) {
    f_.for_each_facet(dim_, *partner, [&](const Cell& facet, int incidence) {
      if (facet == cell) apparent_owner_.pivot = field_.from_int(incidence);
    });
  }
  return &apparent_owner_;
}

template <Filtration F, Field K>
void HomologyReduction<F, K>::reduce_column(const Cell& cell, Ticker& ticker) {
  if constexpr (GraphFiltration<F>) {
    if (dim_ == 1 && !tracks_chains_ && f_.edges_join_vertices()) {
      reduce_edge(cell, ticker);
      return;
    }
  }
  working_.clear();
  chain_.clear();
  f_.for_each_facet(dim_, cell, [&](const Cell& facet, int incidence) {
    working_.append(facet, field_.from_int(incidence));
  });
  ticker.work(working_.size() + 1);
  working_.heapify();
  bool was_added_to = false;
  for (Term pivot; working_.pop_pivot(pivot);) {
    const Column* owner = owner_of(pivot.cell);
    if (!owner) {
      rest_.clear();
      finish_column(cell, pivot, was_added_to);
      return;
    }
    cancel_pivot(pivot, *owner, ticker);
    was_added_to = true;
  }
  finish_essential(cell);
}

template <Filtration F, Field K>
auto HomologyReduction<F, K>::other_end(const Column& column, const Cell& pivot) const -> Cell {
  if (!column.terms.empty()) return terms_[column.terms.begin + 1].cell;
  Cell other = pivot;
  f_.for_each_facet(dim_, column.cell, [&](const Cell& facet, int) {
    if (!(facet == pivot)) other = facet;
  });
  return other;
}

template <Filtration F, Field K>
void HomologyReduction<F, K>::reduce_edge(const Cell& edge, Ticker& ticker) {
  working_.clear();
  rest_.clear();
  f_.for_each_facet(dim_, edge, [&](const Cell& facet, int incidence) {
    rest_.emplace_back(facet, field_.from_int(incidence));
  });
  bool was_added_to = false;
  for (Term& end : rest_) {
    Cell at = end.cell;
    while (const Column* owner = owner_of(at)) {
      at = other_end(*owner, at);
      was_added_to = true;
      ticker.work();
    }
    end = Term(at, end.coefficient());
  }
  if (rest_.empty() || rest_[0].cell == rest_[1].cell) {
    finish_essential(edge);
    return;
  }
  if (f_.precedes(rest_[0].cell, rest_[1].cell)) std::swap(rest_[0], rest_[1]);
  const Term pivot = rest_[0];
  rest_.erase(rest_.begin());
  finish_column(edge, pivot, was_added_to);
}

template <Filtration F, Field K>
auto HomologyReduction<F, K>::store_chain() -> Range {
  const std::size_t begin = chains_.size(), kept = add_up<F, K>(chain_, f_, field_);
  chains_.insert(chains_.end(), chain_.begin(), chain_.begin() + static_cast<std::ptrdiff_t>(kept));
  return {begin, chains_.size()};
}

template <Filtration F, Field K>
void HomologyReduction<F, K>::report_plain(const Cell& column, const Cell& pivot) {
  if (!bars_.add_pair(dim_ - 1, pivot, column) || !tracks_chains_) return;
  std::vector<Term> boundary;
  f_.for_each_facet(dim_, column, [&](const Cell& facet, int incidence) {
    const auto a = field_.from_int(incidence);
    if (!field_.is_zero(a)) boundary.emplace_back(facet, a);
  });
  bars_.add_representative(dim_ - 1, boundary, field_);
}

template <Filtration F, Field K>
void HomologyReduction<F, K>::finish_column(const Cell& cell, const Term& pivot,
                                            bool was_added_to) {
  Column column{cell, pivot.coefficient(), {}, {}};
  if (was_added_to) {
    column.terms.begin = terms_.size();
    terms_.push_back(pivot);
    terms_.insert(terms_.end(), rest_.begin(), rest_.end());
    for (Term term; working_.pop_pivot(term);) terms_.push_back(term);
    column.terms.end = terms_.size();
    if (tracks_chains_) column.chain = store_chain();
  }
  pivots_.insert(pivot.cell, static_cast<std::uint32_t>(columns_.size()));
  columns_.push_back(column);
  if (!was_added_to) {
    report_plain(cell, pivot.cell);
    return;
  }
  if (bars_.add_pair(dim_ - 1, pivot.cell, cell) && tracks_chains_) {
    bars_.add_representative(
        dim_ - 1,
        std::span(terms_).subspan(column.terms.begin, column.terms.end - column.terms.begin),
        field_);
  }
}

template <Filtration F, Field K>
void HomologyReduction<F, K>::finish_essential(const Cell& cell) {
  if (!bars_.add_essential(dim_, cell) || !tracks_chains_) return;
  std::vector<Term> cycle{Term(cell, field_.from_int(1))};
  const std::size_t kept = add_up<F, K>(chain_, f_, field_);
  cycle.insert(cycle.end(), chain_.begin(), chain_.begin() + static_cast<std::ptrdiff_t>(kept));
  bars_.add_representative(dim_, cycle, field_);
}

}  // namespace ph
