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

/// A chain as a heap, the youngest cell first; a cell may be in it several times. Most of what a
/// long chain is added to cancels out, but far below the youngest cell it would stay until it comes
/// up. So the heap is consolidated whenever it has grown to three times what it held.
/// @tparam Term an Entry. @tparam precedes whether a cell is older than another one; best without a
///         branch, which no processor could foretell.
template <Field K, class Term, auto precedes>
class ChainHeap {
 public:
  ChainHeap(const K& field, std::pmr::memory_resource* memory)
      : field_(field), terms_(memory), stay_(memory) {}

  std::size_t size() const { return terms_.size(); }
  void clear() { assign({}); }
  /// @param chain as `consolidate` gave it.
  void assign(std::span<const Term> chain) {
    terms_.assign(chain.begin(), chain.end());
    set_most();
  }
  /// Adds what `append(terms)` appends.
  template <class Append>
  void add(Append&& append) {
    std::size_t place = terms_.size();
    append(terms_);
    if (terms_.size() > most_) {
      consolidate();
      return;
    }
    for (; place < terms_.size(); ++place) sift_up(place);
  }
  /// The youngest cell, or one that cancels out; null if there is none.
  const Term* next() const { return terms_.empty() ? nullptr : &terms_.front(); }
  /// Takes the youngest cell that does not cancel out.
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
  /// Takes the youngest cell that stays what it is; nothing if there is none.
  /// @param replace called with a term: whether it has added to this what the term stands for.
  template <class Replace>
  std::optional<Term> take_pivot(Replace&& replace) {
    std::optional<Term> youngest = take();
    while (youngest && replace(*youngest)) youngest = take();
    return youngest;
  }
  /// Replaces cells below a pivot that was taken out as if they had come up, the youngest first, so
  /// many at most. What replaces a cell may be younger for a while, so the pivot is taken again.
  /// @return the pivot; all that is left is older.
  template <class Replace>
  std::optional<Term> follow(const Term& pivot, std::size_t most, Replace&& replace) {
    stay_.assign(1, pivot);
    while (most > 0) {
      const std::optional<Term> youngest = take();
      if (!youngest) break;
      if (replace(*youngest))
        --most;
      else
        stay_.push_back(*youngest);
    }
    add([&](auto& terms) { terms.insert(terms.end(), stay_.begin(), stay_.end()); });
    return take_pivot(replace);
  }
  /// What it holds, each cell once, from young to old: that is a heap, too.
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
  // Puts a term at a place or below it.
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
  std::size_t most_ = kFew;      // terms before it is consolidated
};

}  // namespace ph::cubical
