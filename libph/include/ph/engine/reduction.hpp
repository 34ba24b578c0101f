// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/core/barcode.hpp"
#include "ph/core/chain.hpp"
#include "ph/core/run_context.hpp"
#include "ph/engine/apparent_pairs.hpp"
#include "ph/engine/cell_map.hpp"

namespace ph {

/// Which matrix is reduced. Both directions are one algorithm read forwards and backwards in the
/// order of the filtration (de Silva, Morozov, Vejdemo-Johansson, Dualities in persistent
/// (co)homology): they find the same pairs.
enum class Direction {
  homology,    ///< columns: boundaries, oldest first; pivot: the youngest facet
  cohomology,  ///< columns: coboundaries, youngest first; pivot: the oldest cofacet
};

/// Reduces the columns of one dimension after the other with clearing (Chen & Kerber, Persistent
/// homology computation with a twist): a cell found as a pivot needs no column of its own in the
/// next dimension. Columns that were never added to are not stored but listed again when needed.
///
/// A column that was added to is kept
///  - in homology as the reduced boundary itself, a cycle that is a boundary from the death on;
///  - in cohomology as the cochain whose coboundary it is, a cocycle until the death: coboundaries
///    are far longer than the cochains.
/// These are the representatives of finite bars. An infinite bar of homology needs the chain whose
/// boundary vanished: with representatives, homology keeps track of the chains, too.
template <Filtration F, Field K, Direction direction>
class Reduction {
 public:
  using Cell = typename F::Cell;

  Reduction(const F& filtration, const K& field, BarcodeBuilder<F>& bars, const RunContext& context)
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
        killers_(&context.memory),
        essential_(&context.memory),
        to_reduce_(&context.memory),
        working_(&context.memory),
        rest_(&context.memory),
        chain_(&context.memory),
        tracks_chains_(!kIsHomology || bars.representatives() != Representatives::none) {}
  Reduction(const Reduction&) = delete;
  Reduction& operator=(const Reduction&) = delete;

  /// Reduces all columns of dimension `dim`. Call with descending dimensions in homology and
  /// ascending ones in cohomology.
  void reduce_dimension(int dim) {
    start_dimension(dim);
    collect_columns();
    reduce_collected();
  }
  /// Homology: reduces these columns of dimension `dim` only, in any order of dimensions. Enough if
  /// all others are zero or apparent and nobody asks for the apparent ones.
  void reduce_columns(int dim, std::span<const Cell> cells) {
    static_assert(kIsHomology);
    start_dimension(dim);
    for (const Cell& cell : cells) {
      if (const auto victim = apparent_.victim_of(dim, cell))
        report_plain(cell, *victim);
      else
        to_reduce_.push_back(cell);
    }
    reduce_collected();
  }
  /// Cohomology: the cells of dimension dim + 1 that killed a class of the dimension reduced last
  /// (those of apparent pairs only if zero-length bars are wanted), and the births of its infinite
  /// bars.
  std::span<const Cell> killers() const { return killers_; }
  std::span<const Cell> essential() const { return essential_; }

  /// The cells of dimension `dim` that are pivots of the dimension before: for the first call to
  /// `reduce_dimension`, when another engine did that dimension.
  void set_cleared(CellMap<F> pivots) { previous_pivots_ = std::move(pivots); }

 private:
  using Term = Entry<Cell, K>;
  static constexpr bool kIsHomology = direction == Direction::homology;

  void start_dimension(int dim) {
    dim_ = dim;
    columns_.clear();
    terms_.clear();
    chains_.clear();
    killers_.clear();
    essential_.clear();
    to_reduce_.clear();
  }
  void reduce_collected() {
    const auto comes_before = [&](const Cell& a, const Cell& b) { return is_below(a, b); };
    if (!std::is_sorted(to_reduce_.begin(), to_reduce_.end(), comes_before))
      std::sort(to_reduce_.begin(), to_reduce_.end(), comes_before);
    Ticker ticker(context_, direction == Direction::homology ? "homology" : "cohomology",
                  to_reduce_.size());
    for (const Cell& cell : to_reduce_) {
      reduce_column(cell, ticker);
      ticker.tick();
    }
    previous_pivots_ = std::move(pivots_);
    pivots_ = CellMap<F>(f_, &context_.memory);
  }

  struct Range {
    std::size_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
  };
  struct Column {
    Cell cell;
    typename K::Element pivot{};  // coefficient of the pivot in the reduced (co)boundary
    Range terms;  // homology: the reduced boundary; empty: the plain boundary of `cell`
    Range chain;  // what was added to `cell`, without it; homology: only with representatives
  };

  // Whether `a` is further from being the pivot than `b`; columns are reduced in this order.
  bool is_below(const Cell& a, const Cell& b) const {
    return kIsHomology ? f_.precedes(a, b) : f_.precedes(b, a);
  }

  void collect_columns();
  void reduce_column(const Cell& cell, Ticker& ticker);
  // @return whether the bar is kept.
  bool report(const Cell& column, const Cell& pivot) {
    if constexpr (kIsHomology)
      return bars_.add_pair(dim_ - 1, pivot, column);
    else
      return bars_.add_pair(dim_, column, pivot);
  }
  // The pair of a column that is the plain (co)boundary of its cell.
  void report_plain(const Cell& column, const Cell& pivot);

  template <class Visit>
  void for_each_entry(const Cell& cell, Visit&& visit) const {
    if constexpr (kIsHomology)
      f_.for_each_facet(dim_, cell, visit);
    else
      f_.for_each_cofacet(dim_, cell, visit);
  }
  void push(const Cell& cell, typename K::Element a) {
    if (field_.is_zero(a)) return;
    working_.emplace_back(cell, a);
    std::push_heap(working_.begin(), working_.end(), below_);
  }
  // Fills the empty working column. True if the pivot showed itself on the way, an emergent pair
  // (Bauer, Ripser, section 3.5); the working column is unfinished then.
  bool start_column(const Cell& cell, Term& pivot, Ticker& ticker);
  // Adds the multiple of `owner` to the working column that cancels the pivot, just popped.
  void cancel_pivot(const Term& pivot, const Column& owner, Ticker& ticker);
  void add_chain(const Column& column, typename K::Element scale);

  // Takes the pivot out of the working column, equal cells added up; false if nothing is left.
  bool pop_pivot(Term& pivot);
  // The column whose pivot `cell` is; null if there is none yet. Valid until the next call.
  const Column* owner_of(const Cell& cell);
  // Homology, dimension 1: the boundary of an edge is the difference of two vertices and stays one
  // under reduction, so it needs no heap. Both entries are reduced to the end: a column stored so
  // leads every later one there in one step.
  void reduce_edge(const Cell& edge, Ticker& ticker);
  // The entry besides the pivot of a column of two.
  Cell other_end(const Column& column, const Cell& pivot) const;
  void finish_column(const Cell& cell, const Term& pivot, bool was_added_to);
  void finish_essential(const Cell& cell);
  // Appends the working chain to chains_, equal cells added up; without the column's own cell.
  Range store_chain();
  // The chain of a column as a representative: `cell` and what was added to it.
  void give_chain(const Cell& cell, Range chain);

  const F& f_;
  const K& field_;
  BarcodeBuilder<F>& bars_;
  const RunContext& context_;
  ApparentPairs<F, K> apparent_;
  int dim_ = 0;
  CellMap<F> pivots_;           // pivot -> position in columns_
  CellMap<F> previous_pivots_;  // of the dimension reduced before
  std::pmr::vector<Column> columns_;
  Column apparent_owner_;
  std::pmr::vector<Term> terms_;   // of reduced boundaries
  std::pmr::vector<Term> chains_;  // of chains
  std::pmr::vector<Cell> killers_, essential_;
  std::pmr::vector<Cell> to_reduce_;
  std::pmr::vector<Term> working_;  // a heap with lazy cancellation
  std::pmr::vector<Term> rest_;     // entries below the pivot of an edge's boundary
  std::pmr::vector<Term> chain_;    // what was added to the working column, in columns
  bool tracks_chains_;

  struct Below {
    const Reduction* self;
    bool operator()(const Term& a, const Term& b) const { return self->is_below(a.cell, b.cell); }
  };
  Below below_{this};
};

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::collect_columns() {
  Ticker ticker(context_, "columns");
  f_.for_each_cell(dim_, [&](const Cell& cell) {
    ticker.tick();
    if (previous_pivots_.find(cell) != CellMap<F>::kAbsent) return;
    if constexpr (kIsHomology) {
      // A pivot of the dimension above; if that dimension is not wanted its cells stay unseen.
      if (dim_ <= bars_.max_dim() && apparent_.killer_of(dim_, cell)) return;
      if (const auto victim = apparent_.victim_of(dim_, cell)) {
        if (bars_.wants_zero_length()) report_plain(cell, *victim);
        return;
      }
    } else {
      if (apparent_.victim_of(dim_, cell)) return;  // a pivot of the dimension below
      if (const auto killer = apparent_.killer_of(dim_, cell)) {
        if (bars_.wants_zero_length()) report_plain(cell, *killer);
        return;
      }
    }
    to_reduce_.push_back(cell);
  });
}

template <Filtration F, Field K, Direction direction>
bool Reduction<F, K, direction>::pop_pivot(Term& pivot) {
  const auto pop = [&] {
    std::pop_heap(working_.begin(), working_.end(), below_);
    const Term term = working_.back();
    working_.pop_back();
    return term;
  };
  while (!working_.empty()) {
    pivot = pop();
    typename K::Element sum = pivot.coefficient();
    while (!working_.empty() && working_.front().cell == pivot.cell)
      sum = field_.add(sum, pop().coefficient());
    if (!field_.is_zero(sum)) {
      pivot = Term(pivot.cell, sum);
      return true;
    }
  }
  return false;
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::cancel_pivot(const Term& pivot, const Column& owner,
                                              Ticker& ticker) {
  const auto scale =
      field_.negate(field_.multiply(pivot.coefficient(), field_.inverse(owner.pivot)));
  if constexpr (kIsHomology) {
    // The pivot stands once in the owner's boundary: leave it out instead of cancelling it.
    if (owner.terms.empty()) {
      for_each_entry(owner.cell, [&](const Cell& entry, int incidence) {
        if (!(entry == pivot.cell)) push(entry, field_.multiply(scale, field_.from_int(incidence)));
      });
    }
    for (std::size_t i = owner.terms.begin + 1; i < owner.terms.end; ++i)
      push(terms_[i].cell, field_.multiply(scale, terms_[i].coefficient()));
    ticker.work(owner.terms.end - owner.terms.begin + 1);
    if (tracks_chains_) add_chain(owner, scale);
  } else {
    push(pivot.cell, pivot.coefficient());
    const std::size_t first = chain_.size();
    add_chain(owner, scale);
    for (std::size_t i = first; i < chain_.size(); ++i) {
      for_each_entry(chain_[i].cell, [&](const Cell& entry, int incidence) {
        push(entry, field_.multiply(chain_[i].coefficient(), field_.from_int(incidence)));
        ticker.work();
        return true;
      });
    }
  }
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::add_chain(const Column& column, typename K::Element scale) {
  chain_.emplace_back(column.cell, scale);
  for (std::size_t i = column.chain.begin; i < column.chain.end; ++i)
    chain_.emplace_back(chains_[i].cell, field_.multiply(scale, chains_[i].coefficient()));
}

template <Filtration F, Field K, Direction direction>
auto Reduction<F, K, direction>::owner_of(const Cell& cell) -> const Column* {
  if (const auto at = pivots_.find(cell); at != CellMap<F>::kAbsent) return &columns_[at];
  const auto partner =
      kIsHomology ? apparent_.killer_of(dim_ - 1, cell) : apparent_.victim_of(dim_ + 1, cell);
  if (!partner) return nullptr;
  apparent_owner_ = {*partner, field_.from_int(1), {}, {}};
  if constexpr (!std::same_as<K, Z2>) {
    for_each_entry(*partner, [&](const Cell& entry, int incidence) {
      if (!(entry == cell)) return true;
      apparent_owner_.pivot = field_.from_int(incidence);
      return false;
    });
  }
  return &apparent_owner_;
}

template <Filtration F, Field K, Direction direction>
bool Reduction<F, K, direction>::start_column(const Cell& cell, Term& pivot, Ticker& ticker) {
  working_.clear();
  chain_.clear();
  bool found = false;
  [[maybe_unused]] bool look_for_pivot = false;
  if constexpr (!kIsHomology) look_for_pivot = F::first_equal_cofacet_is_oldest;
  for_each_entry(cell, [&](const Cell& entry, int incidence) {
    const auto a = field_.from_int(incidence);
    if (field_.is_zero(a)) return true;
    working_.emplace_back(entry, a);
    if constexpr (!kIsHomology) {
      if (look_for_pivot && f_.key(entry) == f_.key(cell)) {
        look_for_pivot = false;
        found = !owner_of(entry);
        if (found) pivot = working_.back();
      }
    }
    return !found;
  });
  ticker.work(working_.size() + 1);
  if (!found) std::make_heap(working_.begin(), working_.end(), below_);
  return found;
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::reduce_column(const Cell& cell, Ticker& ticker) {
  if constexpr (kIsHomology && GraphFiltration<F>) {
    if (dim_ == 1 && !tracks_chains_ && f_.edges_join_vertices()) {
      reduce_edge(cell, ticker);
      return;
    }
  }
  Term pivot;
  if (start_column(cell, pivot, ticker)) {
    finish_column(cell, pivot, false);
    return;
  }
  bool was_added_to = false;
  while (pop_pivot(pivot)) {
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

template <Filtration F, Field K, Direction direction>
auto Reduction<F, K, direction>::other_end(const Column& column, const Cell& pivot) const -> Cell {
  if (!column.terms.empty()) return terms_[column.terms.begin + 1].cell;
  Cell other = pivot;
  for_each_entry(column.cell, [&](const Cell& entry, int) {
    if (!(entry == pivot)) other = entry;
  });
  return other;
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::reduce_edge(const Cell& edge, Ticker& ticker) {
  working_.clear();
  rest_.clear();
  for_each_entry(edge, [&](const Cell& entry, int incidence) {
    rest_.emplace_back(entry, field_.from_int(incidence));
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

template <Filtration F, Field K, Direction direction>
auto Reduction<F, K, direction>::store_chain() -> Range {
  const Range range{chains_.size(), chains_.size()};
  std::sort(chain_.begin(), chain_.end(),
            [&](const Term& a, const Term& b) { return f_.precedes(a.cell, b.cell); });
  for (std::size_t i = 0; i < chain_.size();) {
    const Cell& c = chain_[i].cell;
    auto sum = chain_[i].coefficient();
    for (++i; i < chain_.size() && chain_[i].cell == c; ++i)
      sum = field_.add(sum, chain_[i].coefficient());
    if (!field_.is_zero(sum)) chains_.emplace_back(c, sum);
  }
  return {range.begin, chains_.size()};
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::give_chain(const Cell& cell, Range chain) {
  std::pmr::vector<Term> terms(&context_.memory);
  terms.emplace_back(cell, field_.from_int(1));
  terms.insert(terms.end(), chains_.begin() + static_cast<std::ptrdiff_t>(chain.begin),
               chains_.begin() + static_cast<std::ptrdiff_t>(chain.end));
  bars_.add_representative(dim_, terms, field_);
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::report_plain(const Cell& column, const Cell& pivot) {
  killers_.push_back(pivot);
  if (!report(column, pivot) || bars_.representatives() == Representatives::none) return;
  if constexpr (kIsHomology) {
    std::vector<Term> boundary;
    for_each_entry(column, [&](const Cell& entry, int incidence) {
      const auto a = field_.from_int(incidence);
      if (!field_.is_zero(a)) boundary.emplace_back(entry, a);
    });
    bars_.add_representative(dim_ - 1, boundary, field_);
  } else {
    give_chain(column, {});
  }
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::finish_column(const Cell& cell, const Term& pivot,
                                               bool was_added_to) {
  Column column{cell, pivot.coefficient(), {}, {}};
  if (was_added_to) {
    if constexpr (kIsHomology) {
      column.terms.begin = terms_.size();
      terms_.push_back(pivot);
      terms_.insert(terms_.end(), rest_.begin(), rest_.end());
      for (Term term; pop_pivot(term);) terms_.push_back(term);
      column.terms.end = terms_.size();
    }
    if (tracks_chains_) column.chain = store_chain();
  }
  pivots_.insert(pivot.cell, static_cast<std::uint32_t>(columns_.size()));
  columns_.push_back(column);
  if (!was_added_to) {
    report_plain(cell, pivot.cell);
    return;
  }
  killers_.push_back(pivot.cell);
  if (report(cell, pivot.cell) && bars_.representatives() != Representatives::none) {
    if constexpr (kIsHomology) {
      bars_.add_representative(
          dim_ - 1,
          std::span(terms_).subspan(column.terms.begin, column.terms.end - column.terms.begin),
          field_);
    } else {
      give_chain(cell, column.chain);
    }
  }
}

template <Filtration F, Field K, Direction direction>
void Reduction<F, K, direction>::finish_essential(const Cell& cell) {
  essential_.push_back(cell);
  if (!bars_.add_essential(dim_, cell) || bars_.representatives() == Representatives::none) return;
  const std::size_t stored = chains_.size();
  give_chain(cell, store_chain());
  chains_.resize(stored);
}

}  // namespace ph
