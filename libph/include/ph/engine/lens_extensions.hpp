// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/core/filtration.hpp"
#include "ph/engine/field_rows.hpp"
#include "ph/engine/lens_core.hpp"
#include "ph/engine/lens_forest.hpp"
#include "ph/engine/lens_graph.hpp"
#include "ph/engine/triangle_cocycles.hpp"

namespace ph {

/// The living classes of H2 near a new edge (u,v), and what they become on its star: for each class
/// h a potential p on the lens, p(w) = phi_h(u,v,w), such that p(y) - p(x) = gamma(x,y) :=
/// phi_h(u,x,y) - phi_h(v,x,y) on the edges xy of the lens. Vertices have their numbers in the
/// lens.
template <Field K>
class LensExtensions {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Word = bits::Word;
  using Cocycles = TriangleCocycles<K>;
  using Generator = typename Cocycles::Generator;
  using Row = FieldRow<K>;
  using Unit = typename Row::Unit;

  struct Extension {
    Generator generator;
    typename RowPool<K>::Id potential;
    /// p(x) + gamma(x,y) - p(y) where y is the vertex that came last; zero between vertices.
    typename RowPool<K>::Id mismatch;
    const LinkCochain<K>*at_u = nullptr, *at_v = nullptr;  ///< null: no triangles there
    std::size_t first = 0, last = 0;                       ///< its part of terms_
    bool is_flat = true;                                   ///< the potential is zero so far
    bool is_mismatched = false;
  };

  LensExtensions(const Cocycles& cocycles, const LensGraph& graph, const K& field,
                 std::pmr::memory_resource* memory)
      : cocycles_(cocycles),
        graph_(graph),
        field_(field),
        all_(memory),
        rows_((graph.vertex_count() + 63) / 64, memory),
        gamma_((graph.vertex_count() + 63) / 64 * Row::kUnitsPerBlock, 0, memory),
        terms_(memory) {}

  /// By ascending generator.
  std::pmr::vector<Extension>& all() { return all_; }
  bool empty() const { return all_.empty(); }
  void clear();
  void remove(Extension* x);

  /// Finds the classes whose gamma is, perhaps, not zero on the lens. Calls `prepare` before the
  /// first one: it says which, or null, is an apex of the lens, and gives a core.
  template <class Prepare>
  void find(const FlagEdge& e, Prepare&& prepare);
  /// Cocycles have changed: finds gamma anew.
  void refresh(const FlagEdge& e);
  /// All potentials are zero again.
  void reset();

  Unit* potential(const Extension& x) { return rows_[x.potential]; }
  Unit* mismatch(const Extension& x) { return rows_[x.mismatch]; }
  /// Extends a class to the next vertex of a forest: the first edge to each part decides.
  /// @return whether another edge asks for something else; then see `mismatch`.
  bool extend_to(Extension& x, Vertex y, const LensForest& forest);
  /// Extends a class from the rest of a core to all of the lens.
  void extend_from(Extension& x, const LensCore& core);

 private:
  using Link = LinkCochain<K>;
  using Term = typename Link::Term;

  static bool is_dense(const Link* link) { return link != nullptr && link->is_dense(); }
  void look_up(Extension& x, const FlagEdge& e) const {
    x.at_u = cocycles_.find(x.generator, e.u);
    x.at_v = cocycles_.find(x.generator, e.v);
  }
  /// to += scale * a cocycle's row on the lens, in the first words.
  void add_row(Unit* to, const Unit* row, Element scale, std::size_t words) const;
  /// potential = gamma(apex, .). @return whether it is not zero.
  bool extend_over_cone(Extension& x, Vertex apex);
  /// Copies what lists say of gamma on the lens into terms_, from both ends of each pair.
  void collect_terms(Extension& x);
  /// Whether gamma may be something but zero. @param core of the lens.
  bool has_gamma(const Extension& x, const LensCore& core);
  /// gamma_ = gamma(., y) on a set, in the first words. @return whether that is not zero.
  bool find_gamma(const Extension& x, Vertex y, const Word* set, std::size_t words);

  const Cocycles& cocycles_;
  const LensGraph& graph_;
  const K& field_;
  std::pmr::vector<Extension> all_;
  RowPool<K> rows_;
  std::pmr::vector<Unit> gamma_;
  std::pmr::vector<Term> terms_;  // of a pair (y,x): gamma(x,y)
};

template <Field K>
void LensExtensions<K>::clear() {
  for (const Extension& x : all_) {
    rows_.give(x.potential);
    rows_.give(x.mismatch);
  }
  all_.clear();
  terms_.clear();
}

template <Field K>
void LensExtensions<K>::remove(Extension* x) {
  rows_.give(x->potential);
  rows_.give(x->mismatch);
  all_.erase(all_.begin() + (x - all_.data()));
}

template <Field K>
template <class Prepare>
void LensExtensions<K>::find(const FlagEdge& e, Prepare&& prepare) {
  clear();
  const LensCore* core = nullptr;
  std::optional<Vertex> apex;
  const auto at_u = cocycles_.at(e.u), at_v = cocycles_.at(e.v);
  auto i = at_u.begin(), j = at_v.begin();
  while (i != at_u.end() || j != at_v.end()) {
    Extension x{};
    x.generator = j == at_v.end()   ? i->generator
                  : i == at_u.end() ? j->generator
                                    : std::min(i->generator, j->generator);
    if (i != at_u.end() && i->generator == x.generator) x.at_u = &cocycles_.link(*i++);
    if (j != at_v.end() && j->generator == x.generator) x.at_v = &cocycles_.link(*j++);
    const auto is_near = [&](const Link* link) { return link != nullptr && link->touches(graph_); };
    if (!is_near(x.at_u) && !is_near(x.at_v)) continue;
    if (core == nullptr) core = &prepare(apex);
    x.potential = rows_.take();
    x.mismatch = rows_.take();
    all_.push_back(x);
    if (!apex) collect_terms(all_.back());
    if (!(apex ? extend_over_cone(all_.back(), *apex) : has_gamma(all_.back(), *core)))
      remove(&all_.back());
  }
}

template <Field K>
void LensExtensions<K>::refresh(const FlagEdge& e) {
  terms_.clear();
  for (Extension& x : all_) {
    look_up(x, e);
    collect_terms(x);
  }
}

template <Field K>
void LensExtensions<K>::reset() {
  for (Extension& x : all_) {
    std::fill_n(potential(x), gamma_.size(), Unit{});
    std::fill_n(mismatch(x), gamma_.size(), Unit{});
    x.is_flat = true;
    x.is_mismatched = false;
  }
}

template <Field K>
void LensExtensions<K>::add_row(Unit* to, const Unit* row, Element scale, std::size_t words) const {
  if (graph_.keeps_numbers()) return Row::add(to, row, scale, field_, words);
  bits::for_each(graph_.lens(), 0, words, [&](std::size_t w) {
    const Element a = Row::value(row, graph_.global(static_cast<Vertex>(w)));
    Row::add_at(to, w, field_.multiply(scale, a), field_);
  });
}

template <Field K>
bool LensExtensions<K>::extend_over_cone(Extension& x, Vertex apex) {
  Unit* p = potential(x);
  const Vertex own = graph_.global(apex);
  for (const bool at_v : {false, true}) {
    const Link* link = at_v ? x.at_v : x.at_u;
    if (link == nullptr) continue;
    if (link->is_dense()) {
      if (const Unit* row = link->row(own, cocycles_.shared()))
        add_row(p, row, field_.from_int(at_v ? -1 : 1), graph_.words());
      continue;
    }
    for (const Term& t : link->terms()) {
      const bool is_larger = Link::larger(t) == own;
      if (!is_larger && Link::smaller(t) != own) continue;
      const Vertex w = graph_.local(is_larger ? Link::smaller(t) : Link::larger(t));
      if (w == LensGraph::kNone) continue;
      Row::add_at(p, w, is_larger != at_v ? field_.negate(t.coefficient()) : t.coefficient(),
                  field_);
    }
  }
  return Row::restrict(p, graph_.lens(), graph_.words());
}

template <Field K>
void LensExtensions<K>::collect_terms(Extension& x) {
  const auto add = [&](std::uint32_t pair, Element a) {
    const Vertex larger = graph_.local(pair >> 16), smaller = graph_.local(pair & 0xFFFF);
    if (field_.is_zero(a) || larger == LensGraph::kNone || smaller == LensGraph::kNone) return;
    terms_.emplace_back(Link::pair(larger, smaller), a);
    terms_.emplace_back(Link::pair(smaller, larger), field_.negate(a));
  };
  x.first = terms_.size();
  const auto at_u = x.at_u != nullptr ? x.at_u->terms() : std::span<const Term>();
  const auto at_v = x.at_v != nullptr ? x.at_v->terms() : std::span<const Term>();
  auto i = at_u.begin(), j = at_v.begin();
  while (i != at_u.end() || j != at_v.end()) {
    if (j == at_v.end() || (i != at_u.end() && i->cell < j->cell)) {
      add(i->cell, i->coefficient());
      ++i;
    } else if (i == at_u.end() || j->cell < i->cell) {
      add(j->cell, field_.negate(j->coefficient()));
      ++j;
    } else {
      add(i->cell, field_.add(i->coefficient(), field_.negate(j->coefficient())));
      ++i;
      ++j;
    }
  }
  x.last = terms_.size();
  std::sort(terms_.begin() + static_cast<std::ptrdiff_t>(x.first), terms_.end(),
            [](const Term& a, const Term& b) { return a.cell < b.cell; });
}

template <Field K>
bool LensExtensions<K>::find_gamma(const Extension& x, Vertex y, const Word* set,
                                   std::size_t words) {
  bool is_clear = false;
  const auto clear = [&] {
    if (!is_clear) std::fill_n(gamma_.begin(), words * Row::kUnitsPerBlock, Unit{});
    is_clear = true;
  };
  for (const bool at_v : {false, true}) {
    const Link* link = at_v ? x.at_v : x.at_u;
    if (!is_dense(link)) continue;
    // A row holds phi(u,y,.) = -phi(u,.,y).
    if (const Unit* row = link->row(graph_.global(y), cocycles_.shared())) {
      clear();
      add_row(gamma_.data(), row, field_.from_int(at_v ? 1 : -1), words);
    }
  }
  const auto last = terms_.begin() + static_cast<std::ptrdiff_t>(x.last);
  auto t = std::lower_bound(terms_.begin() + static_cast<std::ptrdiff_t>(x.first), last,
                            Link::pair(y, 0),
                            [](const Term& term, std::uint32_t pair) { return term.cell < pair; });
  for (; t != last && Link::larger(*t) == y && Link::smaller(*t) < 64 * words; ++t) {
    clear();
    Row::add_at(gamma_.data(), Link::smaller(*t), t->coefficient(), field_);
  }
  return is_clear && Row::restrict(gamma_.data(), set, words);
}

template <Field K>
bool LensExtensions<K>::has_gamma(const Extension& x, const LensCore& core) {
  if (!is_dense(x.at_u) && !is_dense(x.at_v)) return x.first != x.last;
  // Potentials depend on what gamma is at hubs and in the rest.
  for (std::size_t i = 0; i < core.hub_count(); ++i)
    if (find_gamma(x, core.hub(i), graph_.lens(), graph_.words())) return true;
  for (std::size_t k = 0; k < graph_.words(); ++k)
    for (Word rest = core.rest()[k]; rest != 0; rest &= rest - 1) {
      const std::size_t y = k * 64 + static_cast<std::size_t>(std::countr_zero(rest));
      if (find_gamma(x, static_cast<Vertex>(y), graph_.lens(), graph_.words())) return true;
    }
  return false;
}

template <Field K>
bool LensExtensions<K>::extend_to(Extension& x, Vertex y, const LensForest& forest) {
  // An edge wy asks that p(y) be p(w) + gamma(w,y).
  const std::size_t words = LensForest::words_to(y);
  if (!find_gamma(x, y, forest.neighbours(), words)) {
    if (x.is_flat) return false;
    std::fill_n(gamma_.begin(), words * Row::kUnitsPerBlock, Unit{});
  }
  Unit* p = potential(x);
  const auto& meetings = forest.meetings();
  const auto asked_at = [&](Vertex w) {
    return field_.add(Row::value(p, w), Row::value(gamma_.data(), w));
  };
  const Element value = asked_at(meetings.front().at);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const Element here = asked_at(meetings[i].at);
    if (Row::difference(mismatch(x), p, gamma_.data(), here, forest.neighbours(i), field_, words))
      x.is_mismatched = true;
    if (here == value) continue;
    Row::shift(p, forest.part(meetings[i]), field_.add(value, field_.negate(here)), field_, words);
    x.is_flat = false;
  }
  if (!field_.is_zero(value)) {
    Row::add_at(p, y, value, field_);
    x.is_flat = false;
  }
  return x.is_mismatched;
}

template <Field K>
void LensExtensions<K>::extend_from(Extension& x, const LensCore& core) {
  Unit* p = potential(x);
  for (std::size_t i = core.hub_count(); i-- > 0;) {
    const Vertex hub = core.hub(i);
    const Element at_hub = Row::value(p, hub);
    // p(w) = p(hub) - gamma(w,hub)
    if (find_gamma(x, hub, core.taken(i), graph_.words()))
      Row::assign(p, gamma_.data(), at_hub, core.taken(i), field_, graph_.words());
    else
      Row::shift(p, core.taken(i), at_hub, field_, graph_.words());
  }
}

}  // namespace ph
