// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/chain.hpp"

namespace ph {

/// The entry of a column that is its pivot. Homology and cohomology are one algorithm, read
/// forwards or backwards in the order of the filtration (de Silva, Morozov, Vejdemo-Johansson,
/// Dualities in persistent (co)homology), and find the same pairs.
enum class Pivot {
  youngest,  ///< for homology: the pivot of a boundary
  oldest,    ///< for cohomology: the pivot of a coboundary
};

/// A column under reduction: a heap of terms with the pivot first; equal cells are added up when
/// they reach the top.
template <class F, class K, Pivot pivot_is>
class WorkingColumn {
 public:
  using Cell = typename F::Cell;
  using Term = Entry<Cell, K>;

  WorkingColumn(const F& filtration, const K& field, std::pmr::memory_resource* memory)
      : field_(field), below_{&filtration}, terms_(memory) {}

  std::size_t size() const { return terms_.size(); }
  void clear() { terms_.clear(); }
  /// Adds a term unless its coefficient is zero.
  void push(const Cell& cell, typename K::Element a) {
    if (!append(cell, a)) return;
    std::push_heap(terms_.begin(), terms_.end(), below_);
  }
  /// Adds one of many terms: call `heapify` after the last one and before anything else.
  /// @return true if the coefficient is not zero.
  bool append(const Cell& cell, typename K::Element a) {
    if (field_.is_zero(a)) return false;
    terms_.emplace_back(cell, a);
    return true;
  }
  void heapify() { std::make_heap(terms_.begin(), terms_.end(), below_); }

  /// Removes the pivot from the column; false if nothing is left.
  bool pop_pivot(Term& pivot) {
    while (!terms_.empty()) {
      pivot = pop();
      typename K::Element sum = pivot.coefficient();
      while (!terms_.empty() && terms_.front().cell == pivot.cell)
        sum = field_.add(sum, pop().coefficient());
      if (!field_.is_zero(sum)) {
        pivot = Term(pivot.cell, sum);
        return true;
      }
    }
    return false;
  }

 private:
  Term pop() {
    std::pop_heap(terms_.begin(), terms_.end(), below_);
    const Term term = terms_.back();
    terms_.pop_back();
    return term;
  }

  struct Below {
    const F* f;
    bool operator()(const Term& a, const Term& b) const {
      return pivot_is == Pivot::youngest ? f->precedes(a.cell, b.cell)
                                         : f->precedes(b.cell, a.cell);
    }
  };
  const K& field_;
  Below below_;
  std::pmr::vector<Term> terms_;
};

/// Sorts a chain by age, oldest first, and adds up equal cells.
/// @return the number of terms left; the terms after them are garbage.
template <class F, class K>
std::size_t add_up(std::span<Entry<typename F::Cell, K>> chain, const F& filtration,
                   const K& field) {
  using Term = Entry<typename F::Cell, K>;
  std::sort(chain.begin(), chain.end(),
            [&](const Term& a, const Term& b) { return filtration.precedes(a.cell, b.cell); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < chain.size();) {
    const auto cell = chain[i].cell;
    auto sum = chain[i].coefficient();
    for (++i; i < chain.size() && chain[i].cell == cell; ++i)
      sum = field.add(sum, chain[i].coefficient());
    if (!field.is_zero(sum)) chain[kept++] = Term(cell, sum);  // mutant: zero-coefficient
  }
  return kept;
}

}  // namespace ph
