// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/annotations/extend_potential.hpp"
#include "libph/src/rips/annotations/link_cochains.hpp"
#include "libph/src/rips/annotations/living_cocycles.hpp"
#include "libph/src/rips/annotations/vertex_functions.hpp"
#include "libph/src/rips/surfaces/triangle_cochain.hpp"
#include "libph/src/rips/sweep/link_cover.hpp"
#include "libph/src/rips/sweep/link_forest.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "ph/detail/core/flag_filtration.hpp"

namespace ph {

/// The living classes of H2 near a new edge (u,v), and their extension to its star. For each class
/// h, the extension is a potential p on the link, where p(w) = phi_h(u,v,w). It must satisfy p(y) -
/// p(x) = gamma(x,y) := phi_h(u,x,y) - phi_h(v,x,y) on the edges xy of the link. Vertices are
/// numbered within the link.
template <Field K>
class LinkExtensions {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Word = bits::Word;
  using Cochain = TriangleCochain<K>;
  using Cocycles = LivingCocycles<Cochain>;
  using Generator = typename Cocycles::Generator;
  using Function = VertexFunction<K>;
  using Unit = typename Function::Unit;

  struct Extension {
    Generator generator;
    const Cochain* cocycle;  ///< null for a loop
    /// For a loop, a cocycle on the link that takes the place of gamma and belongs to no class.
    LinkPairs<K>* loop = nullptr;
    /// The lists of u and v, unless the cocycle is dense.
    typename Cochain::Terms at_u = {}, at_v = {};
    typename RowPool<K>::Id potential = 0;
    /// For an obstructed class, the function p(x) + gamma(x,y) - p(y), where y is the vertex added
    /// last. It is zero again before the next vertex is added.
    typename RowPool<K>::Id mismatch = 0;
    std::size_t first = 0, last = 0;  ///< range of its terms in terms_
    bool is_obstructed = false;       ///< true if no potential fits
    bool is_flat = true;              ///< true if the potential is zero so far
    bool is_mismatched = false;
  };

  LinkExtensions(const Cocycles& cocycles, const LinkGraph& graph, const K& field,
                 std::pmr::memory_resource* memory)
      : cocycles_(cocycles),
        graph_(graph),
        field_(field),
        all_(memory),
        rows_((graph.vertex_count() + 63) / 64, memory),
        gamma_((graph.vertex_count() + 63) / 64 * Function::kUnitsPerBlock, 0, memory),
        terms_(memory) {}

  /// The extensions. Loops come first, then classes by ascending generator.
  std::pmr::vector<Extension>& all() { return all_; }
  /// Adds cocycles of the link that have no potential. They must outlive the work on the edge.
  void add_loops(std::span<LinkPairs<K>* const> loops);
  void clear();
  void remove(Extension* x);

  /// Finds the classes whose gamma is not zero on the link, and their potentials. Before it handles
  /// the first of these classes, calls `prepare` to get a cover of the link. @return true if some
  /// classes have no potential. The potentials and mismatches of these classes are zero.
  template <class Prepare>
  bool find(const FlagEdge& e, Prepare&& prepare);
  /// Computes gamma again for obstructed classes after cocycles have changed.
  void refresh(const FlagEdge& e);

  Unit* potential(const Extension& x) { return rows_[x.potential]; }
  Unit* mismatch(const Extension& x) { return rows_[x.mismatch]; }
  /// Computes loop += scale * gamma.
  void add_gamma(LinkPairs<K>& loop, const Extension& x, const FlagEdge& e, Element scale);
  /// Extends the potential of a class to the next vertex of a forest (see extend_potential).
  /// @return true if another edge requires a different value. In this case, `mismatch` contains the
  /// differences.
  bool extend_to(Extension& x, const FlagEdge& e, Vertex y, const LinkForest& forest);

 private:
  using Term = typename Cochain::Term;

  /// Computes to += scale * row, where `row` is a row of a cocycle. Only the values on the link
  /// count. They are in the first `words` words.
  void add_row(Unit* to, const Unit* row, Element scale, std::size_t words) const;
  /// Finds the potential on a link that has an apex.
  void extend_over_cone(Extension& x, const FlagEdge& e, Vertex apex);
  /// Finds the potential in the order of a cover. @return false if there is no potential.
  bool extend_over(Extension& x, const FlagEdge& e, const LinkCover& cover);
  /// Copies the terms of gamma on the link from lists into terms_, each pair in both orders.
  void collect_terms(Extension& x);
  /// Sets gamma_ = gamma(., y) on a set, in the first `words` words. @return true if any value is
  /// not zero.
  bool find_gamma(const Extension& x, const FlagEdge& e, Vertex y, const Word* set,
                  std::size_t words);

  const Cocycles& cocycles_;
  const LinkGraph& graph_;
  const K& field_;
  std::pmr::vector<Extension> all_;
  RowPool<K> rows_;
  std::pmr::vector<Unit> gamma_;
  std::pmr::vector<Term> terms_;  // for a pair (y,x) in either order, the value gamma(x,y)
};

template <Field K>
void LinkExtensions<K>::clear() {
  while (!all_.empty()) remove(&all_.back());
  terms_.clear();
}

template <Field K>
void LinkExtensions<K>::remove(Extension* x) {
  rows_.give(x->potential);
  if (x->is_obstructed) rows_.give(x->mismatch);
  all_.erase(all_.begin() + (x - all_.data()));
}

template <Field K>
void LinkExtensions<K>::add_loops(std::span<LinkPairs<K>* const> loops) {
  for (LinkPairs<K>* loop : loops) {
    Extension x{.generator = 0, .cocycle = nullptr, .loop = loop};
    x.potential = rows_.take();
    x.mismatch = rows_.take();
    x.is_obstructed = true;
    all_.insert(all_.begin(), x);
  }
}

template <Field K>
void LinkExtensions<K>::add_gamma(LinkPairs<K>& loop, const Extension& x, const FlagEdge& e,
                                  Element scale) {
  const std::size_t words = graph_.words();
  if (x.loop != nullptr) return loop.add(*x.loop, scale, words);
  // Gamma(y,.) = -gamma(.,y).
  bits::for_each(graph_.link(), 0, words, [&](std::size_t y) {
    if (find_gamma(x, e, static_cast<Vertex>(y), graph_.link(), words))
      loop.add_half(static_cast<Vertex>(y), gamma_.data(), field_.negate(scale), words);
  });
}

template <Field K>
template <class Prepare>
bool LinkExtensions<K>::find(const FlagEdge& e, Prepare&& prepare) {
  clear();
  const LinkCover* cover = nullptr;
  bool is_obstructed = false;
  using At = typename Cocycles::At;
  cocycles_.for_each_at(e.u, e.v, [&](Generator h, const At* at_u, const At* at_v) {
    const Cochain& cocycle = cocycles_[h];
    Extension found{.generator = h, .cocycle = &cocycle};
    if (at_u != nullptr) found.at_u = cocycles_.terms(*at_u);
    if (at_v != nullptr) found.at_v = cocycles_.terms(*at_v);
    if (!(at_u != nullptr && cocycle.touches(e.u, found.at_u, graph_)) &&
        !(at_v != nullptr && cocycle.touches(e.v, found.at_v, graph_)))
      return;
    if (cover == nullptr) cover = &prepare();
    found.potential = rows_.take();
    all_.push_back(found);
    Extension& x = all_.back();
    if (cover->size() == 1) {
      extend_over_cone(x, e, (*cover)[0].vertex);
    } else {
      collect_terms(x);
      if (!extend_over(x, e, *cover)) {
        is_obstructed = x.is_obstructed = x.is_flat = true;
        std::fill_n(potential(x), gamma_.size(), Unit{});
        x.mismatch = rows_.take();
      }
    }
    if (x.is_flat && !x.is_obstructed) remove(&x);
  });
  return is_obstructed;
}

template <Field K>
void LinkExtensions<K>::refresh(const FlagEdge& e) {
  terms_.clear();
  for (Extension& x : all_) {
    if (!x.is_obstructed || x.loop != nullptr) continue;
    x.at_u = x.cocycle->terms(e.u, cocycles_.shared());
    x.at_v = x.cocycle->terms(e.v, cocycles_.shared());
    collect_terms(x);
  }
}

template <Field K>
void LinkExtensions<K>::add_row(Unit* to, const Unit* row, Element scale, std::size_t words) const {
  if (graph_.keeps_numbers()) return Function::add(to, row, scale, field_, words);
  bits::for_each(graph_.link(), 0, words, [&](std::size_t w) {
    const Element a = Function::value(row, graph_.global(static_cast<Vertex>(w)));
    Function::add_at(to, w, field_.multiply(scale, a), field_);
  });
}

template <Field K>
void LinkExtensions<K>::extend_over_cone(Extension& x, const FlagEdge& e, Vertex apex) {
  // p(w) = gamma(apex,w)
  Unit* p = potential(x);
  const Vertex own = graph_.global(apex);
  for (const bool at_v : {false, true}) {
    const Vertex end = at_v ? e.v : e.u;
    if (x.cocycle->is_dense()) {
      if (const Unit* row = x.cocycle->row(end, own, cocycles_.shared()))
        add_row(p, row, field_.from_int(at_v == (end < own) ? -1 : 1), graph_.words());
      continue;
    }
    for (const Term& t : at_v ? x.at_v : x.at_u) {  // mutant: surface-cone-end
      const bool is_larger = Cochain::larger(t) == own;
      if (!is_larger && Cochain::smaller(t) != own) continue;
      const Vertex w = graph_.local(is_larger ? Cochain::smaller(t) : Cochain::larger(t));
      if (w == LinkGraph::kNone) continue;
      Function::add_at(p, w, is_larger != at_v ? field_.negate(t.coefficient()) : t.coefficient(),
                       field_);
    }
  }
  x.is_flat = !Function::restrict(p, graph_.link(), graph_.words());
}

template <Field K>
void LinkExtensions<K>::collect_terms(Extension& x) {
  x.first = x.last = terms_.size();
  if (x.cocycle->is_dense()) return;
  const auto add = [&](std::uint32_t at, Element a) {
    const Vertex larger = graph_.local(at >> 16), smaller = graph_.local(at & 0xFFFF);
    if (field_.is_zero(a) || larger == LinkGraph::kNone || smaller == LinkGraph::kNone) return;
    terms_.emplace_back(Cochain::pair(larger, smaller), a);
    terms_.emplace_back(Cochain::pair(smaller, larger), field_.negate(a));
  };
  auto i = x.at_u.begin(), j = x.at_v.begin();
  while (i != x.at_u.end() || j != x.at_v.end()) {
    if (j == x.at_v.end() || (i != x.at_u.end() && i->cell < j->cell)) {
      add(i->cell, i->coefficient());
      ++i;
    } else if (i == x.at_u.end() || j->cell < i->cell) {
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
bool LinkExtensions<K>::find_gamma(const Extension& x, const FlagEdge& e, Vertex y, const Word* set,
                                   std::size_t words) {
  bool is_clear = false;
  const auto clear = [&] {
    if (!is_clear) std::fill_n(gamma_.begin(), words * Function::kUnitsPerBlock, Unit{});
    is_clear = true;
  };
  if (x.loop != nullptr) {
    const Unit* row = x.loop->row(y);
    if (row == nullptr) return false;
    clear();
    Function::add(gamma_.data(), row, field_.from_int(-1), field_, words);
  } else if (x.cocycle->is_dense()) {
    const Vertex own = graph_.global(y);
    for (const bool at_v : {false, true}) {
      const Vertex end = at_v ? e.v : e.u;
      // The row of an edge ab with a < b contains phi(a,b,.) = -phi(a,.,b).
      if (const Unit* row = x.cocycle->row(end, own, cocycles_.shared())) {
        clear();
        add_row(gamma_.data(), row, field_.from_int(at_v == (end < own) ? 1 : -1), words);
      }
    }
  } else {
    const auto last = terms_.begin() + static_cast<std::ptrdiff_t>(x.last);
    auto t = std::lower_bound(terms_.begin() + static_cast<std::ptrdiff_t>(x.first), last,
                              Cochain::pair(y, 0),
                              [](const Term& term, std::uint32_t at) { return term.cell < at; });
    for (; t != last && Cochain::larger(*t) == y && Cochain::smaller(*t) < 64 * words; ++t) {
      clear();
      Function::add_at(gamma_.data(), Cochain::smaller(*t), t->coefficient(), field_);
    }
  }
  return is_clear && Function::restrict(gamma_.data(), set, words);
}

template <Field K>
bool LinkExtensions<K>::extend_over(Extension& x, const FlagEdge& e, const LinkCover& cover) {
  if (!x.cocycle->is_dense() && x.first == x.last) return true;
  const std::size_t words = graph_.words();
  Unit* p = potential(x);
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const auto [y, is_hub] = cover[i];
    const Word* neighbours = cover.neighbours(i);
    const bool is_zero = !find_gamma(x, e, y, neighbours, words);
    if (is_zero && (is_hub || x.is_flat)) continue;
    if (is_hub) {  // p(w) = gamma(hub,w)
      Function::assign(p, gamma_.data(), field_.from_int(0), neighbours, field_, words);
      x.is_flat = false;
      continue;
    }
    if (is_zero) std::fill_n(gamma_.begin(), words * Function::kUnitsPerBlock, Unit{});
    const std::size_t w = bits::first_common(neighbours, neighbours, words);
    const Element value = field_.add(Function::value(p, w), Function::value(gamma_.data(), w));
    // mutant: surface-potential
    if (!Function::is_sum(value, p, gamma_.data(), neighbours, field_, words)) return false;
    if (field_.is_zero(value)) continue;
    Function::add_at(p, y, value, field_);
    x.is_flat = false;
  }
  return true;
}

template <Field K>
bool LinkExtensions<K>::extend_to(Extension& x, const FlagEdge& e, Vertex y,
                                  const LinkForest& forest) {
  const std::size_t words = LinkForest::words_to(y);
  if (!find_gamma(x, e, y, forest.neighbours(), words)) {
    if (x.is_flat) return false;
    std::fill_n(gamma_.begin(), words * Function::kUnitsPerBlock, Unit{});
  }
  const PotentialStep step =
      extend_potential(potential(x), gamma_.data(), mismatch(x), y, forest, field_);
  if (step.mismatched) x.is_mismatched = true;
  if (step.changed) x.is_flat = false;
  return x.is_mismatched;
}

}  // namespace ph
