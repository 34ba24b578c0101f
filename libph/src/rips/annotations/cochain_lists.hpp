// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/annotations/list_pool.hpp"
#include "libph/src/rips/sweep/sorted_terms.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// A cochain of a flag complex, stored as lists of the simplices on which it is not zero. Each of
/// these simplices is in the list of each of its vertices. The entry of a simplex in the list of a
/// vertex a consists of the other vertices of the simplex and the value of the cochain on (a,
/// others in ascending order).
/// @tparam Others a number that encodes the other vertices of a simplex.
template <Field K, class Others>
class CochainLists {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Term = Entry<Others, K>;
  using Terms = std::span<const Term>;
  using ListId = typename ListPool<Term>::Id;
  struct ListAt {
    Vertex vertex;
    ListId list;
  };

  /// Data shared by all cochains of a complex.
  struct Shared {
    Shared(const K& field_, std::pmr::memory_resource* memory)
        : field(field_), lists(memory), merged(memory), own(memory) {}
    const K& field;
    ListPool<Term> lists;
    std::pmr::vector<Term> merged;
    std::pmr::vector<ListId> own;  // lists of this cochain that lists of the other are added to
  };

  explicit CochainLists(std::pmr::memory_resource* memory) : lists_(memory) {}

  /// The lists by ascending vertex; no list is empty.
  const std::pmr::vector<ListAt>& lists() const { return lists_; }
  /// Number of terms in all lists.
  std::size_t term_count() const { return term_count_; }
  Terms terms(Vertex a, const Shared& shared) const {
    const auto at = std::ranges::lower_bound(lists_, a, {}, &ListAt::vertex);
    return at != lists_.end() && at->vertex == a ? Terms(shared.lists[at->list]) : Terms();
  }

  /// Adds scale * other. Calls `on_enter(a, list)` for vertices that get a list, and `on_leave(a)`
  /// for vertices that lose their list.
  template <class OnEnter, class OnLeave>
  void add(CochainLists& other, Element scale, Shared& shared, OnEnter&& on_enter,
           OnLeave&& on_leave);
  /// Adds scale * terms to the list of a. The terms must be in ascending order.
  template <class OnEnter, class OnLeave>
  void add_terms(Vertex a, Terms terms, Element scale, Shared& shared, OnEnter&& on_enter,
                 OnLeave&& on_leave);
  /// Appends terms to the list of a, in any order. No simplex of the terms may occur twice or be in
  /// the list already. The lists are unsorted until the next `add`.
  template <class OnEnter>
  void append_terms(Vertex a, Terms terms, Shared& shared, OnEnter&& on_enter) {
    if (terms.empty()) return;
    auto& list = shared.lists[list_at(a, shared, on_enter).list];
    list.insert(list.end(), terms.begin(), terms.end());
    is_sorted_ = false;
    term_count_ += terms.size();
  }
  /// Makes the cochain zero and returns its lists to the pool.
  void clear(Shared& shared) {
    for (const ListAt& at : lists_) shared.lists.give(at.list);
    std::pmr::vector<ListAt>(lists_.get_allocator()).swap(lists_);
    term_count_ = 0;
  }

 private:
  template <class OnEnter>
  ListAt& list_at(Vertex a, Shared& shared, OnEnter&& on_enter) {
    auto at = std::ranges::lower_bound(lists_, a, {}, &ListAt::vertex);
    if (at == lists_.end() || at->vertex != a) {
      at = lists_.insert(at, {a, shared.lists.take()});
      on_enter(a, at->list);
    }
    return *at;
  }
  void sort(Shared& shared) {
    if (is_sorted_) return;
    is_sorted_ = true;
    for (const ListAt& at : lists_) {
      auto& list = shared.lists[at.list];
      const auto tail = std::ranges::is_sorted_until(list, {}, &Term::cell);
      std::ranges::sort(tail, list.end(), {}, &Term::cell);
      std::ranges::inplace_merge(list, tail, {}, &Term::cell);
    }
  }

  std::pmr::vector<ListAt> lists_;
  std::size_t term_count_ = 0;
  bool is_sorted_ = true;  // true if all lists are sorted
};

template <Field K, class Others>
template <class OnEnter, class OnLeave>
void CochainLists<K, Others>::add_terms(Vertex a, Terms terms, Element scale, Shared& shared,
                                        OnEnter&& on_enter, OnLeave&& on_leave) {
  const ListAt& at = list_at(a, shared, on_enter);
  auto& list = shared.lists[at.list];
  term_count_ -= list.size();
  add_sorted_terms(list, terms, scale, shared.field, shared.merged);
  term_count_ += list.size();
  if (!list.empty()) return;
  shared.lists.give(at.list);
  lists_.erase(lists_.begin() + (&at - lists_.data()));
  on_leave(a);
}

template <Field K, class Others>
template <class OnEnter, class OnLeave>
void CochainLists<K, Others>::add(CochainLists& other, Element scale, Shared& shared,
                                  OnEnter&& on_enter, OnLeave&& on_leave) {
  sort(shared);
  other.sort(shared);
  // Lists are at random places in memory. All lists are therefore prefetched before the first list
  // is used.
  auto& lists = shared.lists;
  auto& own = shared.own;
  own.clear();
  auto at = lists_.begin();
  for (const auto& [a, list] : other.lists_) {
    at = std::ranges::lower_bound(at, lists_.end(), a, {}, &ListAt::vertex);
    if (at == lists_.end() || at->vertex != a) {
      at = lists_.insert(at, {a, lists.take()});
      on_enter(a, at->list);
    }
    own.push_back(at->list);
    for (const ListId id : {list, at->list}) lists.prefetch(id);
  }
  for (std::size_t i = 0; i < own.size(); ++i)
    for (const ListId id : {other.lists_[i].list, own[i]}) lists.prefetch_terms(id);
  bool is_any_zero = false;
  for (std::size_t i = 0; i < own.size(); ++i) {
    auto& list = lists[own[i]];
    term_count_ -= list.size();
    add_sorted_terms(list, Terms(lists[other.lists_[i].list]), scale, shared.field, shared.merged);
    term_count_ += list.size();
    is_any_zero |= list.empty();
  }
  if (!is_any_zero) return;
  std::erase_if(lists_, [&](const ListAt& mine) {
    if (!lists[mine.list].empty()) return false;
    lists.give(mine.list);
    on_leave(mine.vertex);
    return true;
  });
}

}  // namespace ph
