// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/core/bit_matrix.hpp"
#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"
#include "ph/engine/lens_components.hpp"
#include "ph/engine/lens_observer.hpp"
#include "ph/engine/triangle_cocycles.hpp"

namespace ph {

/// H2 of a Vietoris-Rips filtration edge by edge: the part of the lens sweep above H1.
///
/// An edge e = (u,v) enters with its star, glued to what is there along the suspension of its link,
/// the flag complex of the lens. So a class of H2 is born with each component of the lens but one
/// (if that component kills no class of H1) and dies with a loop of the link. Each living class h
/// is held by a cocycle phi_h. It extends to the new triangles by a potential, p(w) = phi_h(u,v,w):
/// p(y) - p(x) = gamma(x,y) := phi_h(u,x,y) - phi_h(v,x,y) for each edge xy of the lens. Where
/// there is none, a class dies. See docs/algorithms.md.
template <Field K>
class LensSurfaces {
 public:
  using Vertex = std::uint32_t;
  using Position = std::uint32_t;
  using Element = typename K::Element;
  using Word = bits::Word;
  using Observer = LensObserver<K>;
  using Triangle = typename Observer::Triangle;

  /// @param joined the edges so far, which outlive this.
  LensSurfaces(const BitMatrix& joined, const K& field, LensWanted wanted, Observer& observer,
               const RunContext& context)
      : joined_(joined),
        field_(field),
        wanted_(wanted),
        observer_(observer),
        cocycles_(joined.rows(), field, wanted.most_terms, &context.memory),
        births_(&context.memory),
        extensions_(&context.memory),
        terms_(&context.memory),
        rows_(joined.words(), &context.memory),
        gamma_(joined.words() * Row::kUnitsPerBlock, 0, &context.memory),
        parts_(&context.memory),
        part_sets_(&context.memory),
        met_(&context.memory),
        met_sets_(&context.memory),
        before_(joined.words(), 0, &context.memory),
        cocycle_(&context.memory) {}

  /// Extends the living classes to the star of an edge; kills those that cannot be.
  /// @param lens of the edge; not empty.
  void extend(Position position, const FlagEdge& e, const Word* lens, LensComponents& components);
  /// A class is born with a component of an edge's lens.
  void give_birth(Triangle birth, const FlagEdge& e, const Word* component);
  /// Reports what never dies.
  void finish();

 private:
  using Cocycles = TriangleCocycles<K>;
  using Generator = typename Cocycles::Generator;
  using Link = LinkCochain<K>;
  using Row = FieldRow<K>;
  using Unit = typename Row::Unit;
  using RowId = typename RowPool<K>::Id;

  /// A living class and what it becomes on the star of the edge.
  struct Extension {
    Generator generator;
    RowId potential;
    RowId mismatch;                               ///< zero between vertices
    const Link *at_u = nullptr, *at_v = nullptr;  ///< null: no triangles there
    std::size_t first = 0, last = 0;              ///< its part of terms_
    bool is_flat = true;                          ///< the potential is zero so far
    bool is_mismatched = false;
    bool is_dead = false;
  };
  /// A component of the part of the lens that was seen so far.
  struct Part {
    Vertex root;
  };
  /// One that the next vertex is joined to, first at a vertex.
  struct Met {
    std::size_t part;
    Vertex at;
  };

  Unit* potential(const Extension& x) { return rows_[x.potential]; }
  Unit* mismatch(const Extension& x) { return rows_[x.mismatch]; }
  static std::size_t blocks_to(Vertex y) { return y / 64 + 1; }
  Word* part_set(std::size_t i) { return part_sets_.data() + i * joined_.words(); }
  Word* met_set(std::size_t i) { return met_sets_.data() + i * joined_.words(); }

  Extension& add_extension(Generator h, const FlagEdge& e);
  void look_up_links(Extension& x, const FlagEdge& e) const {
    x.at_u = cocycles_.find(x.generator, e.u);
    x.at_v = cocycles_.find(x.generator, e.v);
  }
  void drop_extension();
  /// Calls `use(generator)` for the classes with triangles near the edge.
  template <class Use>
  void for_each_near(const FlagEdge& e, const Word* lens, Use&& use) const;
  /// potential = gamma(apex, .). @return whether it is not zero.
  bool extend_over_cone(Extension& x, Vertex apex, const Word* lens);
  /// Sets x.first, x.last to the terms of gamma on the lens that come from lists.
  void collect_terms(Extension& x, const Word* lens);
  /// Whether gamma is not zero somewhere on the lens.
  bool has_gamma(const Extension& x, const Word* lens);
  /// gamma_ = gamma(., y) on a set of vertices below y. @return whether it is not zero.
  bool find_gamma(const Extension& x, Vertex y, const Word* set);

  /// Goes through the edges of the lens in the order of their tetrahedra.
  /// @param is_extended whether the potentials are known.
  void scan(Position position, const FlagEdge& e, const Word* lens, bool is_extended);
  void meet_parts(Vertex y, const Word* lens);
  bool extend_to(Extension& x, Vertex y);
  void kill_mismatched(Position position, const FlagEdge& e, const Word* lens, Vertex y);
  void merge_parts(Position position, const FlagEdge& e, Vertex y);
  void store(Extension& x, const FlagEdge& e, const Word* lens, const LensComponents& components);

  void add_star_to_cocycle(const FlagEdge& e, const Unit* star, std::size_t blocks);
  void find_cocycle(Generator h);

  const BitMatrix& joined_;
  const K& field_;
  LensWanted wanted_;
  Observer& observer_;
  Cocycles cocycles_;
  std::pmr::vector<Triangle> births_;  // by generator; edge = kDead once it died
  static constexpr Position kDead = UINT32_MAX;

  // While an edge is added.
  std::pmr::vector<Extension> extensions_;
  std::pmr::vector<typename Link::Term> terms_;
  RowPool<K> rows_;
  std::pmr::vector<Unit> gamma_;
  std::pmr::vector<Part> parts_;
  std::pmr::vector<Word> part_sets_;
  std::pmr::vector<Met> met_;
  std::pmr::vector<Word> met_sets_;
  std::pmr::vector<Word> before_;
  std::pmr::vector<typename Observer::TriangleValue> cocycle_;
};

template <Field K>
void LensSurfaces<K>::give_birth(Triangle birth, const FlagEdge& e, const Word* component) {
  const Generator h = cocycles_.add_generator();
  births_.push_back(birth);
  std::fill(gamma_.begin(), gamma_.end(), Unit{});
  Row::shift(gamma_.data(), component, field_.from_int(1), field_, joined_.words());
  cocycles_.add_star(h, e.u, e.v, gamma_.data());
}

template <Field K>
void LensSurfaces<K>::finish() {
  for (Generator h = 0; h < births_.size(); ++h) {
    if (births_[h].edge == kDead) continue;
    find_cocycle(h);
    observer_.on_essential(births_[h], cocycle_);
  }
}

template <Field K>
template <class Use>
void LensSurfaces<K>::for_each_near(const FlagEdge& e, const Word* lens, Use&& use) const {
  const auto at_u = cocycles_.at(e.u), at_v = cocycles_.at(e.v);
  auto i = at_u.begin(), j = at_v.begin();
  while (i != at_u.end() || j != at_v.end()) {
    const Generator h = j == at_v.end()   ? i->generator
                        : i == at_u.end() ? j->generator
                                          : std::min(i->generator, j->generator);
    bool is_near = false;
    if (i != at_u.end() && i->generator == h) is_near = cocycles_.link(*i++).touches(lens);
    if (j != at_v.end() && j->generator == h)
      is_near = cocycles_.link(*j++).touches(lens) || is_near;
    if (is_near) use(h);
  }
}

template <Field K>
auto LensSurfaces<K>::add_extension(Generator h, const FlagEdge& e) -> Extension& {
  extensions_.push_back({});
  Extension& x = extensions_.back();
  x.generator = h;
  x.potential = rows_.take();
  x.mismatch = rows_.take();
  look_up_links(x, e);
  return x;
}

template <Field K>
void LensSurfaces<K>::drop_extension() {
  rows_.give(extensions_.back().potential);
  rows_.give(extensions_.back().mismatch);
  extensions_.pop_back();
}

template <Field K>
void LensSurfaces<K>::extend(Position position, const FlagEdge& e, const Word* lens,
                             LensComponents& components) {
  bool looked_for_apex = components.count() > 1;
  terms_.clear();
  for_each_near(e, lens, [&](Generator h) {
    if (!components.has_apex() && !looked_for_apex) {
      looked_for_apex = true;
      components.find_apex(e, lens);
    }
    Extension& x = add_extension(h, e);
    if (components.has_apex() ? extend_over_cone(x, components.apex(), lens)
                              : (collect_terms(x, lens), has_gamma(x, lens)))
      return;
    drop_extension();
  });
  if (wanted_.zero_length || (!extensions_.empty() && !components.has_apex()))
    scan(position, e, lens, components.has_apex());
  for (Extension& x : extensions_)
    if (!x.is_dead) store(x, e, lens, components);
  while (!extensions_.empty()) drop_extension();
}

template <Field K>
bool LensSurfaces<K>::extend_over_cone(Extension& x, Vertex apex, const Word* lens) {
  Unit* p = potential(x);
  const auto& shared = cocycles_.shared();
  for (const bool at_v : {false, true}) {
    const Link* link = at_v ? x.at_v : x.at_u;
    if (link == nullptr) continue;
    if (link->is_dense()) {
      if (const Unit* row = link->row(apex, shared))
        Row::add(p, row, field_.from_int(at_v ? -1 : 1), field_, joined_.words());
      continue;
    }
    for (const auto& t : link->terms()) {
      const bool is_larger = Link::larger(t) == apex;
      if (!is_larger && Link::smaller(t) != apex) continue;
      Row::add_at(p, is_larger ? Link::smaller(t) : Link::larger(t),
                  is_larger != at_v ? field_.negate(t.coefficient()) : t.coefficient(), field_);
    }
  }
  return Row::restrict(p, lens, joined_.words());
}

template <Field K>
void LensSurfaces<K>::collect_terms(Extension& x, const Word* lens) {
  const auto contains = [&](Vertex v) { return lens[v / 64] >> (v % 64) & 1; };
  const auto terms_of = [&](const Link* link) {
    return link == nullptr ? std::span<const typename Link::Term>() : link->terms();
  };
  const auto at_u = terms_of(x.at_u), at_v = terms_of(x.at_v);
  const auto add = [&](std::uint32_t pair, Element a) {
    if (!field_.is_zero(a)) terms_.emplace_back(pair, a);
  };
  const auto is_on_lens = [&](const typename Link::Term& t) {
    return contains(Link::larger(t)) && contains(Link::smaller(t));
  };
  x.first = terms_.size();
  auto i = at_u.begin(), j = at_v.begin();
  while (i != at_u.end() || j != at_v.end()) {
    if (j == at_v.end() || (i != at_u.end() && i->cell < j->cell)) {
      if (is_on_lens(*i)) add(i->cell, i->coefficient());
      ++i;
    } else if (i == at_u.end() || j->cell < i->cell) {
      if (is_on_lens(*j)) add(j->cell, field_.negate(j->coefficient()));
      ++j;
    } else {
      if (is_on_lens(*i))
        add(i->cell, field_.add(i->coefficient(), field_.negate(j->coefficient())));
      ++i;
      ++j;
    }
  }
  x.last = terms_.size();
}

template <Field K>
bool LensSurfaces<K>::find_gamma(const Extension& x, Vertex y, const Word* set) {
  // gamma(x,y) = f_u(x,y) - f_v(x,y), and rows hold f(y,x).
  const std::size_t blocks = blocks_to(y);
  bool is_clear = false;
  const auto clear = [&] {
    if (!is_clear) std::fill_n(gamma_.begin(), blocks * Row::kUnitsPerBlock, Unit{});
    is_clear = true;
  };
  for (const bool at_v : {false, true}) {
    const Link* link = at_v ? x.at_v : x.at_u;
    if (link == nullptr || !link->is_dense()) continue;
    if (const Unit* row = link->row(y, cocycles_.shared())) {
      clear();
      Row::add(gamma_.data(), row, field_.from_int(at_v ? 1 : -1), field_, blocks);
    }
  }
  const auto last = terms_.begin() + static_cast<std::ptrdiff_t>(x.last);
  auto t = std::lower_bound(terms_.begin() + static_cast<std::ptrdiff_t>(x.first), last,
                            Link::pair(y, 0),
                            [](const auto& term, std::uint32_t pair) { return term.cell < pair; });
  for (; t != last && Link::larger(*t) == y; ++t) {
    clear();
    Row::add_at(gamma_.data(), Link::smaller(*t), t->coefficient(), field_);
  }
  return is_clear && Row::restrict(gamma_.data(), set, blocks);
}

template <Field K>
bool LensSurfaces<K>::has_gamma(const Extension& x, const Word* lens) {
  const auto is_dense = [](const Link* link) { return link != nullptr && link->is_dense(); };
  if (!is_dense(x.at_u) && !is_dense(x.at_v)) return x.first != x.last;
  for (std::size_t k = 0; k < joined_.words(); ++k)
    for (Word rest = lens[k]; rest != 0; rest &= rest - 1) {
      const auto y = static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
      if (find_gamma(x, y, lens)) return true;
    }
  return false;
}

template <Field K>
void LensSurfaces<K>::scan(Position position, const FlagEdge& e, const Word* lens,
                           bool is_extended) {
  parts_.clear();
  part_sets_.clear();
  bits::for_each(lens, 0, joined_.words(), [&](std::size_t vertex) {
    const auto y = static_cast<Vertex>(vertex);
    meet_parts(y, lens);
    bool is_mismatched = false;
    if (!met_.empty() && !is_extended)
      for (Extension& x : extensions_)
        if (!x.is_dead) is_mismatched |= extend_to(x, y);
    if (is_mismatched) kill_mismatched(position, e, lens, y);
    merge_parts(position, e, y);
  });
}

template <Field K>
void LensSurfaces<K>::meet_parts(Vertex y, const Word* lens) {
  const std::size_t blocks = blocks_to(y);
  const Word* row = joined_.row(y);
  for (std::size_t k = 0; k < blocks; ++k) before_[k] = lens[k] & row[k];
  before_[y / 64] &= ~(~Word{0} << (y % 64));
  met_.clear();
  for (;;) {
    const std::size_t next = bits::first_common(before_.data(), before_.data(), blocks);
    if (next == bits::kNone) return;
    const auto at = static_cast<Vertex>(next);
    std::size_t part = 0;
    while (!(part_set(part)[at / 64] >> (at % 64) & 1)) ++part;
    met_.push_back({part, at});
    if (met_sets_.size() < met_.size() * joined_.words())
      met_sets_.resize(met_.size() * joined_.words());
    bits::split(before_.data(), part_set(part), met_set(met_.size() - 1), 0, blocks);
  }
}

template <Field K>
bool LensSurfaces<K>::extend_to(Extension& x, Vertex y) {
  // An edge wy asks that p(y) be p(w) + gamma(w,y). The first into each part decides.
  const std::size_t blocks = blocks_to(y);
  for (std::size_t k = 0; k < blocks; ++k) before_[k] = 0;
  for (std::size_t i = 0; i < met_.size(); ++i)
    for (std::size_t k = 0; k < blocks; ++k) before_[k] |= met_set(i)[k];
  const bool has_gamma = find_gamma(x, y, before_.data());
  if (!has_gamma) {
    if (x.is_flat) return false;
    std::fill_n(gamma_.begin(), blocks * Row::kUnitsPerBlock, Unit{});
  }
  Unit* p = potential(x);
  const auto asked = [&](const Met& met) {
    return field_.add(Row::value(p, met.at), Row::value(gamma_.data(), met.at));
  };
  const Element value = asked(met_.front());
  for (std::size_t i = 0; i < met_.size(); ++i) {
    const Element here = asked(met_[i]);
    x.is_mismatched |=
        Row::difference(mismatch(x), p, gamma_.data(), here, met_set(i), field_, blocks);
    if (here == value) continue;
    Row::shift(p, part_set(met_[i].part), field_.add(value, field_.negate(here)), field_, blocks);
    x.is_flat = false;
  }
  if (!field_.is_zero(value)) {
    Row::add_at(p, y, value, field_);
    x.is_flat = false;
  }
  return x.is_mismatched;
}

template <Field K>
void LensSurfaces<K>::kill_mismatched(Position position, const FlagEdge& e, const Word* lens,
                                      Vertex y) {
  const std::size_t blocks = blocks_to(y);
  for (Vertex from = 0;;) {
    // The first tetrahedron on which a class does not extend; the youngest of those dies.
    std::size_t first = bits::kNone;
    for (const Extension& x : extensions_)
      if (x.is_mismatched) first = std::min(first, Row::first(mismatch(x), from, blocks));
    if (first == bits::kNone) break;
    const auto w = static_cast<Vertex>(first);
    Extension* dying = nullptr;  // extensions ascend by generator
    for (Extension& x : extensions_)
      if (x.is_mismatched && !field_.is_zero(Row::value(mismatch(x), w))) dying = &x;
    find_cocycle(dying->generator);
    if (wanted_.cocycles) add_star_to_cocycle(e, potential(*dying), blocks);
    observer_.on_death(births_[dying->generator], {position, y, w}, cocycle_);
    births_[dying->generator].edge = kDead;
    const Element unit = field_.inverse(Row::value(mismatch(*dying), w));
    for (Extension& x : extensions_) {
      if (&x == dying || !x.is_mismatched) continue;
      const Element a = Row::value(mismatch(x), w);
      if (field_.is_zero(a)) continue;
      const Element scale = field_.negate(field_.multiply(a, unit));
      cocycles_.add(x.generator, dying->generator, scale);
      Row::add(potential(x), potential(*dying), scale, field_, blocks);
      Row::add(mismatch(x), mismatch(*dying), scale, field_, blocks);
      x.is_flat = false;
    }
    cocycles_.erase(dying->generator);
    dying->is_dead = true;
    dying->is_mismatched = false;
    for (Extension& x : extensions_) {  // links have moved
      if (x.is_dead) continue;
      look_up_links(x, e);
      collect_terms(x, lens);
    }
    from = w + 1;
  }
  for (Extension& x : extensions_) x.is_mismatched = false;
}

template <Field K>
void LensSurfaces<K>::merge_parts(Position position, const FlagEdge& e, Vertex y) {
  const std::size_t words = joined_.words();
  if (met_.empty()) {
    parts_.push_back({y});
    part_sets_.resize(parts_.size() * words);
    Word* set = part_set(parts_.size() - 1);
    std::fill_n(set, words, Word{0});
    set[y / 64] |= Word{1} << (y % 64);
    return;
  }
  const auto report = [&](Vertex younger, Vertex at, const Word* set) {
    if (!wanted_.zero_length) return;
    cocycle_.clear();
    if (wanted_.cocycles) {
      std::fill(gamma_.begin(), gamma_.end(), Unit{});
      if (set == nullptr)
        Row::add_at(gamma_.data(), younger, field_.from_int(1), field_);
      else
        Row::shift(gamma_.data(), set, field_.from_int(1), field_, words);
      add_star_to_cocycle(e, gamma_.data(), words);
    }
    observer_.on_death({position, younger}, {position, y, at}, cocycle_);
  };
  // The edge to the first part takes in y, each further one a part; the younger root dies.
  std::size_t all = met_.front().part;
  report(y, met_.front().at, nullptr);
  part_set(all)[y / 64] |= Word{1} << (y % 64);
  for (std::size_t i = 1; i < met_.size(); ++i) {
    std::size_t other = met_[i].part;
    if (parts_[other].root < parts_[all].root) std::swap(other, all);
    report(parts_[other].root, met_[i].at, part_set(other));
    for (std::size_t k = 0; k < words; ++k) {
      part_set(all)[k] |= part_set(other)[k];
      part_set(other)[k] = 0;
    }
  }
}

template <Field K>
void LensSurfaces<K>::store(Extension& x, const FlagEdge& e, const Word* lens,
                            const LensComponents& components) {
  // A constant on a component changes the class by younger ones at most: few values are stored.
  Unit* p = potential(x);
  const std::size_t words = joined_.words();
  for (std::size_t i = 0; i < components.count(); ++i) {
    const Word* set = components.count() == 1 ? lens : components.vertices(i);
    const Element most = Row::majority(p, set, field_, words);
    if (!field_.is_zero(most)) Row::shift(p, set, field_.negate(most), field_, words);
  }
  if (!Row::is_zero(p, words)) cocycles_.add_star(x.generator, e.u, e.v, p);
}

template <Field K>
void LensSurfaces<K>::find_cocycle(Generator h) {
  cocycle_.clear();
  if (wanted_.cocycles)
    cocycles_.for_each_triangle(h, [&](Vertex a, Vertex b, Vertex c, Element value) {
      cocycle_.push_back({{a, b, c}, value});
    });
}

template <Field K>
void LensSurfaces<K>::add_star_to_cocycle(const FlagEdge& e, const Unit* star, std::size_t blocks) {
  Row::for_each(star, blocks, [&](std::size_t apex, Element a) {
    std::array<Vertex, 3> vertices{e.v, e.u, static_cast<Vertex>(apex)};
    // phi(u,v,w): an odd number of swaps away from (v,u,w)
    const bool is_odd = vertices[2] > e.u || vertices[2] < e.v;
    std::ranges::sort(vertices);
    cocycle_.push_back({vertices, is_odd ? field_.negate(a) : a});
  });
}

extern template class LensSurfaces<Z2>;
extern template class LensSurfaces<Zp>;

}  // namespace ph
