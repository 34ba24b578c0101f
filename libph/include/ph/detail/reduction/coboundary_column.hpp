// SPDX-License-Identifier: MIT
#pragma once
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/range_filtration.hpp"
#include "ph/detail/reduction/working_column.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// A coboundary under reduction: the coboundary of a cell plus the coboundary of the chain that was
/// added to the cell.
///
/// Over a RangeFiltration the column holds only the cofacets up to a key, the limit. When all of
/// them are gone, the limit rises: the cofacets up to the next limit are listed from the cell and
/// the chain. Most cofacets are younger than the final pivot and are never put into the column; see
/// docs/explanation/engines/cohomology.md.
template <CofacetFiltration F, Field K>
class CoboundaryColumn {
 public:
  using Cell = typename F::Cell;
  using Term = Entry<Cell, K>;

  CoboundaryColumn(const F& filtration, const K& field, const RunContext& context)
      : f_(filtration),
        field_(field),
        context_(context),
        terms_(filtration, field, &context.memory),
        chain_(&context.memory) {}

  /// Begins with a cell alone. `goes_on(cofacet, coefficient)` is called for each cofacet when it
  /// is listed. Once it returns false, the column stays unfinished and must be started again.
  template <class GoesOn>
  void start(int dim, const Cell& cell, GoesOn&& goes_on) {
    begin(dim, cell, f_.key(cell));
    list(cell, f_.key(cell), [&](const Cell& cofacet, int incidence) {
      const auto a = field_.from_int(incidence);
      return !terms_.append(cofacet, a) || goes_on(cofacet, a);
    });
    terms_.heapify();
  }
  /// Begins with a cell and a chain whose coboundary has the pivot `pivot`.
  void start(int dim, const Cell& cell, std::span<const Term> chain, const Cell& pivot) {
    begin(dim, cell, f_.key(pivot));
    chain_.assign(chain.begin(), chain.end());
    append_all(f_.key(pivot));
  }

  /// Removes the oldest term; false if nothing is left.
  bool pop_pivot(Term& pivot) {
    while (!terms_.pop_pivot(pivot))
      if (!raise_limit()) return false;  // mutant: limit-rises
    return true;
  }
  /// Puts back `pivot`, the term that was removed, and adds `scale` times another column, given by
  /// a cell and a chain whose coboundary has the same pivot.
  void add(const Term& pivot, const Cell& cell, std::span<const Term> chain,
           typename K::Element scale) {
    terms_.push(pivot.cell, pivot.coefficient());
    // Terms older than the pivot cancel: cofacets of smaller keys are left out.
    const auto add_coboundary = [&](const Cell& summand, typename K::Element a) {
      chain_.emplace_back(summand, a);
      list(summand, f_.key(pivot.cell), [&](const Cell& cofacet, int incidence) {
        terms_.push(cofacet, field_.multiply(a, field_.from_int(incidence)));
        return true;
      });
    };
    add_coboundary(cell, scale);
    for (const Term& term : chain)
      add_coboundary(term.cell, field_.multiply(scale, term.coefficient()));
  }

  /// The cells that were added, each once, oldest first.
  std::span<const Term> chain() {
    chain_.resize(add_up<F, K>(chain_, f_, field_));
    return chain_;
  }

 private:
  using Key = decltype(std::declval<const F&>().key(std::declval<const Cell&>()));
  static constexpr Key kNoLimit = std::numeric_limits<Key>::max();
  static constexpr std::size_t kPollInterval = 4096;  // steps

  void begin(int dim, const Cell& cell, Key first) {
    dim_ = dim;
    cell_ = cell;
    terms_.clear();
    chain_.clear();
    set_limit(first);
  }
  void set_limit(Key first) {
    if constexpr (RangeFiltration<F>) limit_ = f_.horizon(first);
  }
  bool raise_limit() {
    if (limit_ == kNoLimit) return false;
    const Key first = limit_ + 1;  // mutant: limit-first
    set_limit(first);
    terms_.clear();
    chain();  // cells that cancel need not be listed
    append_all(first);
    return true;
  }

  /// Fills the column, which must be empty, from the key `first` on.
  void append_all(Key first) {
    const auto append = [&](const Cell& summand, typename K::Element a) {
      list(summand, first, [&](const Cell& cofacet, int incidence) {
        terms_.append(cofacet, field_.multiply(a, field_.from_int(incidence)));
        return true;
      });
    };
    append(cell_, field_.from_int(1));
    for (const Term& term : chain_) append(term.cell, term.coefficient());  // mutant: limit-chain
    terms_.heapify();
  }
  /// Lists cofacets up to the limit. Cofacets before `first` are not needed.
  template <class Visit>
  void list(const Cell& cell, Key first, Visit&& visit) {
    const std::size_t before = terms_.size();
    if constexpr (RangeFiltration<F>)
      f_.for_each_cofacet_within(dim_, cell, first, limit_, visit);
    else
      f_.for_each_cofacet(dim_, cell, visit);
    pending_ += terms_.size() - before + 1;
    if (pending_ < kPollInterval) return;
    pending_ = 0;
    context_.poll();
  }

  const F& f_;
  const K& field_;
  const RunContext& context_;
  int dim_ = 0;
  Cell cell_{};
  Key limit_ = kNoLimit;
  WorkingColumn<F, K, Pivot::oldest> terms_;
  std::pmr::vector<Term> chain_;
  std::size_t pending_ = 0;
};

}  // namespace ph
