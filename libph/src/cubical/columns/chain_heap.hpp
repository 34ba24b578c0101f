// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/core/field.hpp"

namespace ph::cubical {

/// A chain as a heap, youngest cell first. A cell may occur several times. When chains are added,
/// most terms cancel. However, equal cells are found only at the top of the heap, so terms far
/// older than the youngest cell would stay for a long time. The heap is therefore consolidated
/// whenever it has grown to about three times its consolidated size. A short heap may grow more.
/// @tparam Term an Entry. @tparam precedes true if its first argument is older than the second. It
/// should be branchless, because processors cannot predict the result.
template <Field K, class Term, auto precedes>
class ChainHeap {
 public:
  ChainHeap(const K& field, std::pmr::memory_resource* memory)
      : field_(field), terms_(memory), stay_(memory) {}

  std::size_t size() const { return terms_.size(); }
  void clear() { assign({}); }
  /// @param chain in the form that `consolidate` returns.
  void assign(std::span<const Term> chain) {
    terms_.assign(chain.begin(), chain.end());
    set_most();
  }
  /// Adds the terms that `append(terms)` appends.
  template <class Append>
  void add(Append&& append) {
    std::size_t place = terms_.size();
    append(terms_);
    if (terms_.size() > most_) {
      consolidate();  // mutant: chain-long
      return;
    }
    for (; place < terms_.size(); ++place) sift_up(place);
  }
  /// The youngest cell, which may still cancel; null if there is none.
  const Term* next() const { return terms_.empty() ? nullptr : &terms_.front(); }
  /// Removes and returns the youngest cell that does not cancel.
  std::optional<Term> take() {
    while (!terms_.empty()) {
      const Term first = pop();
      auto sum = first.coefficient();
      while (!terms_.empty() && terms_.front().cell == first.cell)
        sum = field_.add(sum, pop().coefficient());
      if (!field_.is_zero(sum)) return Term(first.cell, sum);
    }
    return std::nullopt;
  }
  /// Removes and returns the youngest cell that `replace` does not replace. Returns nothing if
  /// there is no such cell.
  /// @param replace called with a term: if the term has a replacement, adds it to this chain and
  /// returns true.
  template <class Replace>
  std::optional<Term> take_pivot(Replace&& replace) {
    std::optional<Term> youngest = take();
    while (youngest && replace(*youngest)) youngest = take();
    return youngest;
  }
  /// Replaces cells older than a pivot that was removed, youngest first, up to a maximum number. A
  /// replacement may be younger than the pivot for a while; the pivot is therefore put back and
  /// taken again.
  /// @return the pivot; all other cells are older.
  template <class Replace>
  std::optional<Term> follow(const Term& pivot, std::size_t most, Replace&& replace) {
    stay_.assign(1, pivot);  // mutant: chain-pivot-stays
    while (most > 0) {
      const std::optional<Term> youngest = take();
      if (!youngest) break;
      if (replace(*youngest))
        --most;
      else
        stay_.push_back(*youngest);
    }
    add([&](auto& terms) { terms.insert(terms.end(), stay_.begin(), stay_.end()); });
    return take_pivot(replace);  // mutant: chain-replace
  }
  /// The terms of the chain, from young to old. Each cell occurs once. A list in this order is also
  /// a heap.
  std::span<const Term> consolidate() {
    std::sort(terms_.begin(), terms_.end(),
              [](const Term& a, const Term& b) { return precedes(b.cell, a.cell); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < terms_.size();) {
      const auto cell = terms_[i].cell;
      auto sum = terms_[i].coefficient();
      for (++i; i < terms_.size() && terms_[i].cell == cell; ++i)
        sum = field_.add(sum, terms_[i].coefficient());
      if (!field_.is_zero(sum)) terms_[kept++] = Term(cell, sum);
    }
    terms_.resize(kept);
    set_most();
    return terms_;
  }

 private:
  static constexpr std::size_t kFew = 64;

  void set_most() {
    constexpr std::size_t times = 3;
    most_ = times * terms_.size() + kFew;
  }
  Term pop() {
    const Term top = terms_.front(), last = terms_.back();
    terms_.pop_back();
    if (!terms_.empty()) sift_down(0, last);
    return top;
  }
  // Puts a term at a position or further down, so that the heap remains valid.
  void sift_down(std::size_t place, const Term term) {
    Term* const terms = terms_.data();
    const std::size_t size = terms_.size();
    std::size_t child = 2 * place + 1;
    for (; child + 1 < size; child = 2 * place + 1) {
      child += precedes(terms[child].cell, terms[child + 1].cell) ? 1 : 0;
      if (!precedes(term.cell, terms[child].cell)) break;
      terms[place] = terms[child];
      place = child;
    }
    if (child + 1 == size && precedes(term.cell, terms[child].cell)) {
      terms[place] = terms[child];
      place = child;
    }
    terms[place] = term;
  }
  void sift_up(std::size_t place) {
    Term* const terms = terms_.data();
    const Term term = terms[place];
    while (place > 0) {
      const std::size_t parent = (place - 1) / 2;
      if (!precedes(terms[parent].cell, term.cell)) break;
      terms[place] = terms[parent];
      place = parent;
    }
    terms[place] = term;
  }

  const K& field_;
  std::pmr::vector<Term> terms_;
  std::pmr::vector<Term> stay_;  // see `follow`
  std::size_t most_ = kFew;      // the heap is consolidated when it has more terms
};

}  // namespace ph::cubical
