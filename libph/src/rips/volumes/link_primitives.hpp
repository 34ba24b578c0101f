// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/annotations/link_cochains.hpp"
#include "libph/src/rips/annotations/vertex_functions.hpp"
#include "libph/src/rips/sweep/link_cover.hpp"
#include "libph/src/rips/sweep/link_forest.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "ph/detail/core/bit_matrix.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// Looks for primitives of 2-cocycles gamma on the flag complex M of a link. A primitive is a
/// 1-cochain psi with coboundary gamma. The class also looks for *loops*, which are 1-cocycles that
/// form a basis of H^1(M).
///
/// M grows vertex by vertex. A new vertex z is joined to its link in the part of M so far. On that
/// link, psi(z,.) must be a potential: psi(z,y) - psi(z,x) = psi(x,y) - gamma(z,x,y). A loop begins
/// with each component of the link of z except one. Some searches may have no potential on that
/// link. If one of these searches is for a loop, multiples of that loop are added to the others,
/// and the loop is dropped. If none of them is for a loop, the gamma of each of these searches has
/// no primitive. See docs/explanation/engines/edge-links-h3.md.
template <Field K>
class LinkPrimitives {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Word = bits::Word;
  using Function = VertexFunction<K>;
  using Unit = typename Function::Unit;
  static constexpr std::uint32_t kLoop = UINT32_MAX;

  /// The search for a primitive of one gamma, or a loop.
  struct Search {
    Search(RowPool<K>& rows, const K& field, std::pmr::memory_resource* memory)
        : gamma(rows, field, memory), psi(rows, field, memory) {}
    bool is_loop() const { return generator == kLoop; }

    std::uint32_t generator = kLoop;  ///< the class of gamma
    LinkTriples<K> gamma;             ///< zero for a loop
    LinkPairs<K> psi;
    bool is_active = true;       ///< true if the search continues, or if the loop is still valid
    bool is_obstructed = false;  ///< true if gamma has no primitive
    bool is_found = false;       ///< true if psi is a primitive
    // While a vertex z is added: the row psi(z,.), and the row of the differences between the
    // values that an edge requires and psi(z,.).
    typename RowPool<K>::Id potential = 0, mismatch = 0;
    bool is_flat = true, is_mismatched = false;
  };

  LinkPrimitives(LinkGraph& graph, const K& field, std::pmr::memory_resource* memory)
      : graph_(graph),
        field_(field),
        memory_(memory),
        rows_((graph.vertex_count() + 63) / 64, memory),
        searches_(memory),
        cover_(graph, memory),
        parts_(graph, memory),
        parts_of_star_(graph, memory),
        before_(memory),
        loop_vertices_(memory),
        asked_((graph.vertex_count() + 63) / 64 * Function::kUnitsPerBlock, 0, memory) {}

  /// The searches so far. The searches for classes come first, then the loops.
  std::span<Search* const> all() const { return {used_.data(), used_.size()}; }
  void clear();
  /// Adds a search for a class or for a loop.
  Search& add(std::uint32_t generator);
  /// Removes the last search.
  void drop_last();

  /// Finds all primitives and loops, in the order of a cover of the link.
  void search(const LinkCover& cover);
  /// Drops the loops. Then looks again for primitives of the obstructed classes, in the order of
  /// the filtration, with ascending vertices. At the first triangle z > y > w where some searches
  /// are mismatched, calls `on_obstruction(search, z, y, w)` for the mismatched search with the
  /// largest generator. Then calls `on_add(search, obstructed, scale)` for each of the other
  /// mismatched searches. After this addition, these searches have no mismatch.
  template <class OnObstruction, class OnAdd>
  void search_in_order(OnObstruction&& on_obstruction, OnAdd&& on_add);

 private:
  /// Sets asked_ to the required values of psi(z,.) - psi(z,y), up to a constant, on a set of
  /// neighbours of y and z. @return true if any of these is not zero.
  bool find_asked(const Search& s, Vertex z, Vertex y, const Word* set, std::size_t words);
  void begin_vertex();
  void end_vertex(Vertex z);
  void add_over(Vertex z, const Word* around);
  /// Extends psi(z,.) to a vertex y of the link of z. @param around the earlier neighbours of y,
  /// which must be in one part (see extend_over_parts). @return true if a search is mismatched.
  bool extend_to(Vertex z, Vertex y, const Word* around);
  bool extend_over_parts(Vertex z, Vertex y);
  /// The last loop that is mismatched at w, or null. @param w the first vertex where any search is
  /// mismatched.
  Search* mismatched_loop(Vertex w);
  std::size_t first_mismatch(std::size_t from) const;
  Element mismatch_of(const Search& s, Vertex w) const {
    return s.is_mismatched ? Function::value(rows_[s.mismatch], w) : field_.from_int(0);
  }
  /// Makes the mismatch at w zero for all searches except `by`, by adding multiples of `by` to
  /// them.
  template <class OnAdd>
  void correct_others(Search& by, Vertex w, OnAdd&& on_add);
  void settle_mismatches();
  /// Begins a loop with each part of the link of z. If several parts belong to the same part of M,
  /// one of them is left out.
  void find_loops_over_parts();
  void begin_loops(Vertex z);
  /// Marks active searches as found.
  void finish();

  LinkGraph& graph_;
  const K& field_;
  std::pmr::memory_resource* memory_;
  RowPool<K> rows_;
  std::pmr::deque<Search> searches_;  // kept for reuse
  std::vector<Search*> used_;
  LinkCover cover_;                   // for the link of a vertex
  LinkForest parts_, parts_of_star_;  // parts of the link, and parts of the link of a vertex in it
  std::pmr::vector<Word> before_;     // the link of a vertex in the current complex
  std::pmr::vector<Word> loop_vertices_;  // one row per loop that begins
  std::pmr::vector<Unit> asked_;
};

template <Field K>
void LinkPrimitives<K>::clear() {
  for (Search* s : used_) {
    s->gamma.clear();
    s->psi.clear();
  }
  used_.clear();
}

template <Field K>
auto LinkPrimitives<K>::add(std::uint32_t generator) -> Search& {
  if (used_.size() == searches_.size()) searches_.emplace_back(rows_, field_, memory_);
  Search& s = searches_[used_.size()];
  s.generator = generator;
  s.is_active = true;
  s.is_obstructed = s.is_found = false;
  used_.push_back(&s);
  return s;
}

template <Field K>
void LinkPrimitives<K>::drop_last() {
  used_.back()->gamma.clear();
  used_.back()->psi.clear();
  used_.pop_back();
}

template <Field K>
bool LinkPrimitives<K>::find_asked(const Search& s, Vertex z, Vertex y, const Word* set,
                                   std::size_t words) {
  // psi(x,y) - gamma(z,x,y) = gamma(z,y,x) - psi(y,x)
  const Unit* pairs = s.psi.row(y);
  const Unit* triples = s.is_loop() ? nullptr : s.gamma.row(z, y);
  if (pairs == nullptr && triples == nullptr) return false;
  std::fill_n(asked_.begin(), words * Function::kUnitsPerBlock, Unit{});
  if (pairs != nullptr) Function::add(asked_.data(), pairs, field_.from_int(-1), field_, words);
  if (triples != nullptr)
    Function::add(asked_.data(), triples, field_.from_int(z < y ? 1 : -1), field_, words);
  return Function::restrict(asked_.data(), set, words);
}

template <Field K>
void LinkPrimitives<K>::begin_vertex() {
  for (Search* s : used_) {
    s->is_flat = true;
    s->is_mismatched = false;
    if (!s->is_active) continue;
    s->potential = rows_.take();
    s->mismatch = rows_.take();
  }
  loop_vertices_.clear();
}

template <Field K>
void LinkPrimitives<K>::end_vertex(Vertex z) {
  for (Search* s : used_) {
    if (!s->is_active) continue;
    if (!s->is_flat) s->psi.add_row(z, rows_[s->potential], graph_.words());
    rows_.give(s->potential);
    rows_.give(s->mismatch);
  }
  begin_loops(z);
}

template <Field K>
void LinkPrimitives<K>::begin_loops(Vertex z) {
  const std::size_t words = graph_.words();
  for (std::size_t at = 0; at < loop_vertices_.size(); at += words) {
    std::fill_n(asked_.begin(), words * Function::kUnitsPerBlock, Unit{});
    Function::shift(asked_.data(), loop_vertices_.data() + at, field_.from_int(1), field_, words);
    add(kLoop).psi.add_row(z, asked_.data(), words);
  }
}

template <Field K>
void LinkPrimitives<K>::search(const LinkCover& cover) {
  const std::size_t words = graph_.words();
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const auto [z, is_hub] = cover[i];
    const Word* around = cover.neighbours(i);
    if (!is_hub) {
      add_over(z, around);
      continue;
    }
    // psi(x,y) = gamma(hub,x,y)
    for (Search* s : used_) {
      if (s->is_loop()) continue;
      bits::for_each(around, 0, words, [&, hub = z](std::size_t x) {
        const Unit* row = s->gamma.row(hub, static_cast<Vertex>(x));
        if (row == nullptr) return;
        std::copy_n(row, words * Function::kUnitsPerBlock, asked_.begin());
        if (Function::restrict(asked_.data(), around, words))
          // mutant: volume-cone-sign
          s->psi.add_half(static_cast<Vertex>(x), asked_.data(), field_.from_int(hub < x ? 1 : -1),
                          words);
      });
    }
  }
  finish();
}

template <Field K>
void LinkPrimitives<K>::finish() {
  for (Search* s : used_) {
    if (s->is_loop() || !s->is_active) continue;
    s->is_found = true;
    s->is_active = false;
  }
}

template <Field K>
void LinkPrimitives<K>::add_over(Vertex z, const Word* around) {
  const std::size_t words = graph_.words();
  cover_.find(around);
  begin_vertex();
  for (std::size_t i = 0; i < cover_.size(); ++i) {
    const auto [y, is_hub] = cover_[i];
    const Word* joined = cover_.neighbours(i);
    if (!is_hub) {
      if (extend_to(z, y, joined)) settle_mismatches();  // mutant: volume-mismatch
    } else {
      for (Search* s : used_) {
        if (!s->is_active || !find_asked(*s, z, y, joined, words)) continue;
        // psi(z,x) - psi(z,hub) = -(psi(z,hub) - psi(z,x))
        Function::assign(rows_[s->potential], asked_.data(), field_.from_int(0), joined, field_,
                         words);
        s->is_flat = false;
      }
      if (i > 0) loop_vertices_.resize(loop_vertices_.size() + words);  // mutant: volume-link-parts
    }
    if (loop_vertices_.empty()) continue;
    Word* row = loop_vertices_.data() + loop_vertices_.size() - words;
    row[y / 64] |= Word{1} << (y % 64);
    for (std::size_t k = 0; is_hub && k < words; ++k) row[k] |= joined[k];
  }
  end_vertex(z);
}

template <Field K>
bool LinkPrimitives<K>::extend_to(Vertex z, Vertex y, const Word* around) {
  const std::size_t words = graph_.words();
  const std::size_t first = bits::first_common(around, around, words);
  bool is_mismatched = false;
  for (Search* s : used_) {
    if (!s->is_active) continue;
    if (!find_asked(*s, z, y, around, words)) {
      if (s->is_flat) continue;
      std::fill_n(asked_.begin(), words * Function::kUnitsPerBlock, Unit{});
    }
    Unit* p = rows_[s->potential];
    const Element value =
        field_.add(Function::value(p, first), Function::value(asked_.data(), first));
    if (Function::difference(rows_[s->mismatch], p, asked_.data(), value, around, field_, words))
      is_mismatched = s->is_mismatched = true;
    if (field_.is_zero(value)) continue;
    Function::add_at(p, y, value, field_);
    s->is_flat = false;
  }
  return is_mismatched;
}

template <Field K>
std::size_t LinkPrimitives<K>::first_mismatch(std::size_t from) const {
  std::size_t first = bits::kNone;
  for (const Search* s : used_)
    if (s->is_mismatched)
      first = std::min(first, Function::first(rows_[s->mismatch], from, graph_.words()));
  return first;
}

template <Field K>
auto LinkPrimitives<K>::mismatched_loop(Vertex w) -> Search* {
  for (std::size_t i = used_.size(); i-- > 0 && used_[i]->is_loop();)
    if (!field_.is_zero(mismatch_of(*used_[i], w))) return used_[i];
  return nullptr;
}

template <Field K>
template <class OnAdd>
void LinkPrimitives<K>::correct_others(Search& by, Vertex w, OnAdd&& on_add) {
  const std::size_t words = graph_.words();
  const Element inverse = field_.inverse(mismatch_of(by, w));
  for (Search* s : used_) {
    const Element a = s == &by ? field_.from_int(0) : mismatch_of(*s, w);
    if (field_.is_zero(a)) continue;
    const Element scale = field_.negate(field_.multiply(a, inverse));
    s->psi.add(by.psi, scale, words);
    Function::add(rows_[s->potential], rows_[by.potential], scale, field_, words);
    Function::add(rows_[s->mismatch], rows_[by.mismatch], scale, field_, words);
    s->is_flat = false;
    if (!by.is_loop()) {
      s->gamma.add(by.gamma, scale, words);  // mutant: volume-other-gamma
      on_add(*s, by, scale);
    }
  }
  by.is_active = by.is_mismatched = false;  // mutant: volume-used-loop
  rows_.give(by.potential);
  rows_.give(by.mismatch);
}

template <Field K>
void LinkPrimitives<K>::settle_mismatches() {
  for (std::size_t w; (w = first_mismatch(0)) != bits::kNone;) {
    if (Search* loop = mismatched_loop(static_cast<Vertex>(w))) {
      correct_others(*loop, static_cast<Vertex>(w), [](auto&&...) {});
      continue;
    }
    for (Search* s : used_) {
      if (field_.is_zero(mismatch_of(*s, static_cast<Vertex>(w)))) continue;
      s->is_obstructed = true;
      s->is_active = s->is_mismatched = false;
      rows_.give(s->potential);
      rows_.give(s->mismatch);
    }
  }
  for (Search* s : used_) s->is_mismatched = false;
}

}  // namespace ph

#include "libph/src/rips/volumes/link_primitives.ipp"
