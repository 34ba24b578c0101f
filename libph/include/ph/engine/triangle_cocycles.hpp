// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/core/chain.hpp"
#include "ph/core/field.hpp"
#include "ph/core/run_context.hpp"
#include "ph/engine/field_rows.hpp"
#include "ph/engine/lens_graph.hpp"

namespace ph {

/// What a 2-cochain phi is on the triangles at one vertex a: the antisymmetric function
/// f(b,c) = phi(a,b,c). Few pairs are a sorted list, many are rows.
template <Field K>
class LinkCochain {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Row = FieldRow<K>;
  using Unit = typename Row::Unit;
  using Word = bits::Word;
  /// A pair of vertices, named by `pair`, with f(smaller, larger).
  using Term = Entry<std::uint32_t, K>;

  /// Pairs ascend by the larger vertex, then by the smaller one.
  static std::uint32_t pair(Vertex larger, Vertex smaller) { return larger << 16 | smaller; }
  static Vertex larger(const Term& t) { return t.cell >> 16; }
  static Vertex smaller(const Term& t) { return t.cell & 0xFFFF; }
  /// Two vertices make a pair, so there are at most this many.
  static constexpr std::size_t kMostVertices = 1 << 16;

  /// What all links of a complex share.
  struct Shared {
    Shared(const K& field_, std::size_t blocks_, std::size_t most_terms_,
           std::pmr::memory_resource* memory)
        : field(field_),
          blocks(blocks_),
          most_terms(most_terms_ * FieldRow<K>::kUnitsPerBlock * sizeof(Unit) / sizeof(Word)),
          rows(blocks_, memory),
          merged(memory),
          row(memory) {}
    const K& field;
    std::size_t blocks;
    std::size_t most_terms;  // of a list; more become rows, later where these are wider than bits
    RowPool<K> rows;
    std::pmr::vector<Term> merged, row;
  };

  explicit LinkCochain(std::pmr::memory_resource* memory)
      : terms_(memory), present_(memory), rows_(memory) {}

  bool is_dense() const { return !rows_.empty(); }
  /// Unless it is dense.
  std::span<const Term> terms() const { return terms_; }
  /// Whether a pair within a lens may have a value; no false "no".
  bool touches(const LensGraph& graph) const;
  /// c -> f(b,c) if it is dense; null if that is zero.
  const Unit* row(Vertex b, const Shared& shared) const {
    return has_row(b) ? shared.rows[rows_[b]] : nullptr;
  }

  void add(std::span<const Term> terms, Shared& shared);
  void add(const LinkCochain& other, Element scale, Shared& shared);
  /// f(b,.) += scale * row.
  void add_row(Vertex b, const Unit* row, Element scale, Shared& shared);
  /// Makes it zero and gives back what it held.
  void clear(Shared& shared);
  /// Calls `visit(smaller, larger, value)`.
  template <class Visit>
  void for_each(const Shared& shared, Visit&& visit) const;

 private:
  bool has_row(Vertex b) const { return present_[b / 64] >> (b % 64) & 1; }
  Unit* made_row(Vertex b, Shared& shared);
  void add_pair(const Term& t, Shared& shared);
  /// shared.merged = terms_ + terms.
  void merge(std::span<const Term> terms, Shared& shared);
  void make_dense(Shared& shared);
  void drop_zero_rows(Shared& shared);

  std::pmr::vector<Term> terms_;
  std::pmr::vector<Word> present_;                  // the vertices with a row
  std::pmr::vector<typename RowPool<K>::Id> rows_;  // by vertex
};

/// Living classes of H^2 by their cocycles: functions on triangles, stored where they are not zero,
/// at each of the three vertices.
template <Field K>
class TriangleCocycles {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth
  using Vertex = std::uint32_t;
  using Link = LinkCochain<K>;
  using Element = typename K::Element;
  using Unit = typename FieldRow<K>::Unit;
  /// A generator with triangles at a vertex.
  struct At {
    Generator generator;
    std::uint32_t link;
  };

  /// @param most_terms of a link; those with more are stored in rows.
  TriangleCocycles(std::size_t vertices, const K& field, std::size_t most_terms,
                   const RunContext& context)
      : context_(context),
        shared_(field, (vertices + 63) / 64, most_terms, &context.memory),
        links_(&context.memory),
        free_(&context.memory),
        at_(vertices, &context.memory),
        vertices_(&context.memory) {}

  Generator add_generator() {
    vertices_.emplace_back();
    return static_cast<Generator>(vertices_.size() - 1);
  }
  void erase(Generator g);
  /// to += scale * from.
  void add(Generator to, Generator from, Element scale);
  /// phi(u,v,w) += star(w) for all w; u > v, and no such triangle has a value yet.
  void add_star(Generator g, Vertex u, Vertex v, const Unit* star);

  /// The generators with triangles at a vertex, ascending.
  std::span<const At> at(Vertex a) const { return at_[a]; }
  const Link& link(const At& at) const { return links_[at.link]; }
  const typename Link::Shared& shared() const { return shared_; }
  /// Null if the generator has no triangles there.
  const Link* find(Generator g, Vertex a) const {
    const auto it = position(g, a);
    return it != at_[a].end() && it->generator == g ? &links_[it->link] : nullptr;
  }
  /// Calls `visit(a, b, c, phi(a,b,c))` for a < b < c.
  template <class Visit>
  void for_each_triangle(Generator g, Visit&& visit) const;

 private:
  auto position(Generator g, Vertex a) const {
    return std::ranges::lower_bound(at_[a], g, {}, &At::generator);
  }
  Link& made_link(Generator g, Vertex a);

  const RunContext& context_;
  typename Link::Shared shared_;
  std::pmr::vector<Link> links_;
  std::pmr::vector<std::uint32_t> free_;  // of links_
  std::pmr::vector<std::pmr::vector<At>> at_;
  std::pmr::vector<std::pmr::vector<Vertex>> vertices_;  // by generator: where it has links
};

template <Field K>
bool LinkCochain<K>::touches(const LensGraph& graph) const {
  const auto contains = [&](Vertex v) { return graph.local(v) != LensGraph::kNone; };
  if (!is_dense())
    return std::ranges::any_of(
        terms_, [&](const Term& t) { return contains(larger(t)) && contains(smaller(t)); });
  if (graph.keeps_numbers())
    return bits::first_common(present_.data(), graph.lens(), present_.size()) != bits::kNone;
  bool touches = false;
  bits::for_each(graph.lens(), 0, graph.words(), [&](std::size_t w) {
    touches = touches || has_row(graph.global(static_cast<Vertex>(w)));
  });
  return touches;
}

template <Field K>
auto LinkCochain<K>::made_row(Vertex b, Shared& shared) -> Unit* {
  if (!has_row(b)) {
    rows_[b] = shared.rows.take();
    present_[b / 64] |= Word{1} << (b % 64);
  }
  return shared.rows[rows_[b]];
}

template <Field K>
void LinkCochain<K>::add_pair(const Term& t, Shared& shared) {
  Row::add_at(made_row(smaller(t), shared), larger(t), t.coefficient(), shared.field);
  Row::add_at(made_row(larger(t), shared), smaller(t), shared.field.negate(t.coefficient()),
              shared.field);
}

template <Field K>
void LinkCochain<K>::make_dense(Shared& shared) {
  present_.resize(shared.blocks);
  rows_.resize(64 * shared.blocks);
  for (const Term& t : terms_) add_pair(t, shared);
  std::pmr::vector<Term>(terms_.get_allocator()).swap(terms_);
}

template <Field K>
void LinkCochain<K>::add(std::span<const Term> terms, Shared& shared) {
  if (!is_dense() && terms_.size() + terms.size() > 2 * shared.most_terms) make_dense(shared);
  if (is_dense()) {
    for (const Term& t : terms) add_pair(t, shared);
    return;
  }
  if (terms.size() == 1) {
    const auto at = std::ranges::lower_bound(terms_, terms[0].cell, {}, &Term::cell);
    if (at == terms_.end() || at->cell != terms[0].cell) {
      terms_.insert(at, terms[0]);
      return;
    }
  }
  merge(terms, shared);
  terms_.assign(shared.merged.begin(), shared.merged.end());
  if (terms_.size() > shared.most_terms) make_dense(shared);
}

template <Field K>
void LinkCochain<K>::merge(std::span<const Term> terms, Shared& shared) {
  auto& merged = shared.merged;
  merged.resize(terms_.size() + terms.size());
  const Term *i = terms_.data(), *const end = i + terms_.size();
  const Term *j = terms.data(), *const last = j + terms.size();
  Term* out = merged.data();
  while (i != end && j != last) {
    if constexpr (std::same_as<K, Z2>) {  // which comes first is anyone's guess: no branches
      const std::uint32_t a = i->cell, b = j->cell;
      *out = a < b ? *i : *j;
      out += a != b ? 1 : 0;
      i += a <= b ? 1 : 0;
      j += b <= a ? 1 : 0;
    } else if (i->cell != j->cell) {
      *out++ = i->cell < j->cell ? *i++ : *j++;
    } else {
      const Element sum = shared.field.add(i->coefficient(), (j++)->coefficient());
      if (!shared.field.is_zero(sum)) *out++ = Term(i->cell, sum);
      ++i;
    }
  }
  out = std::copy(j, last, std::copy(i, end, out));
  merged.resize(static_cast<std::size_t>(out - merged.data()));
}

template <Field K>
void LinkCochain<K>::add_row(Vertex b, const Unit* row, Element scale, Shared& shared) {
  const K& field = shared.field;
  if (!is_dense()) {
    auto& terms = shared.row;
    terms.clear();
    Row::for_each(row, shared.blocks, [&](std::size_t other, Element a) {
      const auto c = static_cast<Vertex>(other);
      const Element value = field.multiply(scale, a);
      terms.emplace_back(pair(std::max(b, c), std::min(b, c)), b < c ? value : field.negate(value));
    });
    return add(terms, shared);
  }
  Row::add(made_row(b, shared), row, scale, field, shared.blocks);
  const Element opposite = field.negate(scale);
  Row::for_each(row, shared.blocks, [&](std::size_t c, Element a) {
    Row::add_at(made_row(static_cast<Vertex>(c), shared), b, field.multiply(opposite, a), field);
  });
}

template <Field K>
void LinkCochain<K>::add(const LinkCochain& other, Element scale, Shared& shared) {
  if (!other.is_dense()) {
    if (scale == shared.field.from_int(1)) return add(other.terms_, shared);
    std::pmr::vector<Term> scaled(other.terms_.get_allocator());
    for (const Term& t : other.terms_)
      scaled.emplace_back(t.cell, shared.field.multiply(scale, t.coefficient()));
    return add(scaled, shared);
  }
  if (!is_dense()) make_dense(shared);
  bits::for_each(other.present_.data(), 0, shared.blocks, [&](std::size_t b) {
    Unit* to = made_row(static_cast<Vertex>(b), shared);
    Row::add(to, shared.rows[other.rows_[b]], scale, shared.field, shared.blocks);
  });
  drop_zero_rows(shared);
}

template <Field K>
void LinkCochain<K>::drop_zero_rows(Shared& shared) {
  bits::for_each(present_.data(), 0, shared.blocks, [&](std::size_t b) {
    if (!Row::is_zero(shared.rows[rows_[b]], shared.blocks)) return;
    shared.rows.give(rows_[b]);
    present_[b / 64] &= ~(Word{1} << (b % 64));
  });
}

template <Field K>
void LinkCochain<K>::clear(Shared& shared) {
  bits::for_each(present_.data(), 0, present_.size(),
                 [&](std::size_t b) { shared.rows.give(rows_[b]); });
  *this = LinkCochain(terms_.get_allocator().resource());
}

template <Field K>
template <class Visit>
void LinkCochain<K>::for_each(const Shared& shared, Visit&& visit) const {
  for (const Term& t : terms_) visit(smaller(t), larger(t), t.coefficient());
  bits::for_each(present_.data(), 0, present_.size(), [&](std::size_t b) {
    Row::for_each(shared.rows[rows_[b]], shared.blocks, [&](std::size_t c, Element a) {
      if (b < c) visit(static_cast<Vertex>(b), static_cast<Vertex>(c), a);
    });
  });
}

template <Field K>
auto TriangleCocycles<K>::made_link(Generator g, Vertex a) -> Link& {
  const auto it = position(g, a);
  if (it != at_[a].end() && it->generator == g) return links_[it->link];
  const auto index = it - at_[a].begin();
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(links_.size()));
    links_.emplace_back(links_.get_allocator().resource());
  }
  at_[a].insert(at_[a].begin() + index, At{g, free_.back()});
  vertices_[g].push_back(a);
  const std::uint32_t link = free_.back();
  free_.pop_back();
  return links_[link];
}

template <Field K>
void TriangleCocycles<K>::erase(Generator g) {
  for (const Vertex a : vertices_[g]) {
    const auto it = position(g, a);
    links_[it->link].clear(shared_);
    free_.push_back(it->link);
    at_[a].erase(it);
  }
  std::pmr::vector<Vertex>(vertices_.get_allocator()).swap(vertices_[g]);
}

template <Field K>
void TriangleCocycles<K>::add(Generator to, Generator from, Element scale) {
  for (const Vertex a : vertices_[from]) {
    context_.poll();  // a large cocycle takes long
    Link& sum = made_link(to, a);
    sum.add(*find(from, a), scale, shared_);
  }
}

template <Field K>
void TriangleCocycles<K>::add_star(Generator g, Vertex u, Vertex v, const Unit* star) {
  using Term = typename Link::Term;
  const K& field = shared_.field;
  // phi(u,v,w) = phi(w,u,v) = -phi(v,u,w)
  made_link(g, u).add_row(v, star, field.from_int(1), shared_);
  made_link(g, v).add_row(u, star, field.from_int(-1), shared_);
  FieldRow<K>::for_each(star, shared_.blocks, [&](std::size_t apex, Element a) {
    const Term only(Link::pair(u, v), field.negate(a));
    made_link(g, static_cast<Vertex>(apex)).add({&only, 1}, shared_);
  });
}

template <Field K>
template <class Visit>
void TriangleCocycles<K>::for_each_triangle(Generator g, Visit&& visit) const {
  for (const Vertex c : vertices_[g])
    find(g, c)->for_each(shared_, [&](Vertex a, Vertex b, Element value) {
      if (b < c) visit(a, b, c, value);
    });
}

}  // namespace ph
