// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "libph/src/rips/annotations/cochain_lists.hpp"
#include "libph/src/rips/annotations/vertex_functions.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// A 2-cochain phi of a flag complex, which is an alternating function of three vertices. Only its
/// non-zero values are stored. If it has few triangles, they are stored as sorted lists, and each
/// triangle is in the lists of its three corners. If it has many triangles, the cochain is dense:
/// the values phi(a,b,.) are stored as rows, one for each edge (a,b) with a < b.
template <Field K>
class TriangleCochain {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Function = VertexFunction<K>;
  using Unit = typename Function::Unit;
  using Word = bits::Word;
  /// `pair` names the other two vertices of a triangle.
  using Lists = CochainLists<K, std::uint32_t>;
  using Term = typename Lists::Term;
  using Terms = typename Lists::Terms;
  using ListId = typename Lists::ListId;

  /// Encodes a pair as a number. Pairs are ordered by the larger vertex, then by the smaller one.
  static std::uint32_t pair(Vertex larger, Vertex smaller) { return larger << 16 | smaller; }
  static Vertex larger(const Term& t) { return t.cell >> 16; }
  static Vertex smaller(const Term& t) { return t.cell & 0xFFFF; }
  /// The largest number of vertices, because a vertex takes 16 bits.
  static constexpr std::size_t kMostVertices = 1 << 16;

  /// Data shared by all cochains of a complex.
  struct Shared : Lists::Shared {
    Shared(const K& field_, std::size_t vertices, std::size_t most_terms_,
           std::pmr::memory_resource* memory)
        : Lists::Shared(field_, memory),
          blocks((vertices + 63) / 64),
          most_terms(most_terms_ * Function::kUnitsPerBlock * sizeof(Unit) / sizeof(Word)),
          rows(blocks, memory),
          star(memory) {}
    std::size_t blocks;
    // The largest number of terms in lists. With more terms, a cochain becomes dense. If there are
    // many cochains, twice this number is allowed (see adapt).
    std::size_t most_terms;
    std::size_t living = 0;  // cochains in use
    RowPool<K> rows;
    std::pmr::vector<Term> star;
  };

  explicit TriangleCochain(std::pmr::memory_resource* memory) : lists_(memory), at_(memory) {}

  bool is_dense() const { return !at_.empty(); }
  /// The list of a vertex, unless the cochain is dense.
  Terms terms(Vertex a, const Shared& shared) const { return lists_.terms(a, shared); }
  /// False only if the cochain is zero on all triangles at a whose other two vertices are in the
  /// link.
  /// @param terms the list of a.
  bool touches(Vertex a, Terms terms, const LinkGraph& graph) const;
  /// For a dense cochain, returns phi(a,b,.) if a < b, otherwise -phi(a,b,.). Returns null if this
  /// function is zero.
  const Unit* row(Vertex a, Vertex b, const Shared& shared) const {
    return has_row(a, b) ? shared.rows[at_[a].rows[b]] : nullptr;
  }
  /// The approximate cost of adding this cochain to another one.
  std::size_t size() const { return is_dense() ? row_count_ * at_.size() : lists_.term_count(); }

  /// Adds scale * other. Calls `on_enter(a, list)` for vertices that get their first triangle, and
  /// `on_leave(a)` for vertices that may have lost their last triangle.
  template <class OnEnter, class OnLeave>
  void add(TriangleCochain& other, Element scale, Shared& shared, OnEnter&& on_enter,
           OnLeave&& on_leave);
  /// Computes phi(u,v,w) += star(w) for all w. Preconditions: u > v, and these triangles have no
  /// values yet.
  template <class OnEnter>
  void add_star(Vertex u, Vertex v, const Unit* star, Shared& shared, OnEnter&& on_enter);
  /// Makes the cochain zero and frees its memory. Calls `on_leave(a)` in the same way as `add`.
  template <class OnLeave>
  void clear(Shared& shared, OnLeave&& on_leave);

  /// Calls `visit(a, b, c, phi(a,b,c))` for a < b < c.
  template <class Visit>
  void for_each_triangle(const Shared& shared, Visit&& visit) const;

 private:
  /// The rows of the edges at a vertex.
  struct RowsAt {
    explicit RowsAt(std::pmr::memory_resource* memory) : present(memory), rows(memory) {}
    std::pmr::vector<Word> present;                  // indexed by the other end
    std::pmr::vector<typename RowPool<K>::Id> rows;  // indexed by the other end
  };

  bool has_row(Vertex a, Vertex b) const {
    const auto& present = at_[a].present;
    return !present.empty() && (present[b / 64] >> (b % 64) & 1) != 0;
  }
  /// The row of an edge, which is made if it does not exist.
  Unit* made_row(Vertex a, Vertex b, Shared& shared) {
    if (!has_row(a, b)) make_row(a, b, shared);
    return shared.rows[at_[a].rows[b]];
  }
  template <class OnEnter>
  void enter(Vertex a, const Shared& shared, OnEnter&& on_enter) {
    if (!at_[a].present.empty()) return;
    at_[a].present.resize(shared.blocks);
    on_enter(a, 0);
  }
  void make_row(Vertex a, Vertex b, Shared& shared);
  /// Computes phi(a,b,c) += value in the row of the edge ab, where a < b.
  void add_to_row(Vertex a, Vertex b, Vertex c, Element value, Shared& shared) {
    Function::add_at(made_row(a, b, shared), c, value, shared.field);
  }
  /// Makes the cochain dense if it is large.
  void adapt(Shared& shared) {
    // If there are many cochains, lists are kept longer, because the rows of many cochains would
    // displace each other from the caches.
    constexpr std::size_t many = 16;
    const std::size_t most = shared.living < many ? shared.most_terms : 2 * shared.most_terms;
    if (!is_dense() && lists_.term_count() > most) make_dense(shared);
  }
  void make_dense(Shared& shared);
  template <class OnEnter>
  void add_star_to_rows(Vertex u, Vertex v, const Unit* star, Shared& shared, OnEnter&& on_enter);
  void drop_zero_rows(Shared& shared);
  /// Calls `visit(a)` for the vertices of the cochain's triangles and possibly for some other
  /// vertices, in ascending order.
  template <class Visit>
  void for_each_vertex(Visit&& visit) const;
  /// Calls `visit(a, b, row id)` for a < b.
  template <class Visit>
  void for_each_row(Visit&& visit) const;

  Lists lists_;                  // empty if the cochain is dense
  std::pmr::vector<RowsAt> at_;  // rows at each vertex; empty unless the cochain is dense
  std::size_t row_count_ = 0;
};

template <Field K>
bool TriangleCochain<K>::touches(Vertex a, Terms terms, const LinkGraph& graph) const {
  const auto contains = [&](Vertex v) { return graph.local(v) != LinkGraph::kNone; };
  if (!is_dense())
    return std::ranges::any_of(
        terms, [&](const Term& t) { return contains(larger(t)) && contains(smaller(t)); });
  const auto& present = at_[a].present;
  if (present.empty()) return false;
  if (graph.keeps_numbers())
    return bits::first_common(present.data(), graph.link(), present.size()) != bits::kNone;
  bool touches = false;
  bits::for_each(graph.link(), 0, graph.words(), [&](std::size_t w) {
    touches = touches || has_row(a, graph.global(static_cast<Vertex>(w)));
  });
  return touches;
}

template <Field K>
void TriangleCochain<K>::make_row(Vertex a, Vertex b, Shared& shared) {
  const auto id = shared.rows.take();
  ++row_count_;
  for (const auto& [one, other] : {std::pair{a, b}, std::pair{b, a}}) {
    at_[one].present.resize(shared.blocks);
    at_[one].present[other / 64] |= Word{1} << (other % 64);
    at_[one].rows.resize(at_.size());
    at_[one].rows[other] = id;
  }
}

template <Field K>
void TriangleCochain<K>::make_dense(Shared& shared) {
  const auto memory = at_.get_allocator().resource();
  at_.reserve(64 * shared.blocks);
  for (std::size_t a = 0; a < 64 * shared.blocks; ++a) at_.emplace_back(memory);
  for (const auto& [a, list] : lists_.lists())
    for (const Term& t : shared.lists[list])
      add_to_row(smaller(t), larger(t), a, t.coefficient(), shared);
  lists_.clear(shared);
}

template <Field K>
template <class OnEnter, class OnLeave>
void TriangleCochain<K>::add(TriangleCochain& other, Element scale, Shared& shared,
                             OnEnter&& on_enter, OnLeave&& on_leave) {
  adapt(shared);
  if (!is_dense() && other.is_dense()) make_dense(shared);
  if (!is_dense()) return lists_.add(other.lists_, scale, shared, on_enter, on_leave);
  other.for_each_vertex([&](Vertex a) { enter(a, shared, on_enter); });
  for (const auto& [a, list] : other.lists_.lists()) {
    for (const Term& t : shared.lists[list])
      add_to_row(smaller(t), larger(t), a, shared.field.multiply(scale, t.coefficient()), shared);
  }
  if (!other.is_dense()) return;
  other.for_each_row([&](Vertex a, Vertex b, typename RowPool<K>::Id id) {
    Unit* to = made_row(a, b, shared);
    Function::add(to, shared.rows[id], scale, shared.field, shared.blocks);
  });
  drop_zero_rows(shared);
}

template <Field K>
template <class OnEnter>
void TriangleCochain<K>::add_star_to_rows(Vertex u, Vertex v, const Unit* star, Shared& shared,
                                          OnEnter&& on_enter) {
  enter(u, shared, on_enter);
  enter(v, shared, on_enter);
  Function::add(made_row(v, u, shared), star, shared.field.from_int(-1), shared.field,
                shared.blocks);
  Function::for_each(star, shared.blocks, [&](std::size_t apex, Element) {
    const auto w = static_cast<Vertex>(apex);
    enter(w, shared, on_enter);
    if (!has_row(u, w)) make_row(u, w, shared);
    if (!has_row(v, w)) make_row(v, w, shared);
  });
  // Rows are at random places in memory. All rows are therefore prefetched before the first row is
  // used.
  const auto *of_u = at_[u].rows.data(), *of_v = at_[v].rows.data();
  Function::for_each(star, shared.blocks, [&](std::size_t w, Element) {
    __builtin_prefetch(of_u + w);
    __builtin_prefetch(of_v + w);
  });
  Function::for_each(star, shared.blocks, [&](std::size_t w, Element) {
    Function::prefetch(shared.rows[of_u[w]], v);
    Function::prefetch(shared.rows[of_v[w]], u);
  });
  Function::for_each(star, shared.blocks, [&](std::size_t w, Element a) {
    const Element opposite = shared.field.negate(a);
    // mutant: surface-star-row
    Function::add_at(shared.rows[of_u[w]], v, w < u ? a : opposite, shared.field);
    Function::add_at(shared.rows[of_v[w]], u, v < w ? a : opposite, shared.field);
  });
}

template <Field K>
template <class OnEnter>
void TriangleCochain<K>::add_star(Vertex u, Vertex v, const Unit* star, Shared& shared,
                                  OnEnter&& on_enter) {
  const K& field = shared.field;
  const Element one = field.from_int(1);
  // phi(u,v,w) = phi(w,u,v) = phi(v,w,u)
  adapt(shared);
  if (is_dense()) return add_star_to_rows(u, v, star, shared, on_enter);
  const auto on_leave = [](Vertex) {};  // nothing cancels
  auto& terms = shared.star;
  for (const auto& [end, other] : {std::pair{u, v}, std::pair{v, u}}) {
    terms.clear();
    Function::for_each(star, shared.blocks, [&](std::size_t apex, Element a) {
      const auto w = static_cast<Vertex>(apex);
      // mutant: surface-star-sign
      terms.emplace_back(pair(std::max(other, w), std::min(other, w)),
                         (end == u) == (other < w) ? a : field.negate(a));
    });
    lists_.add_terms(end, terms, one, shared, on_enter, on_leave);
  }
  Function::for_each(star, shared.blocks, [&](std::size_t apex, Element a) {
    const Term only(pair(u, v), field.negate(a));
    lists_.add_terms(static_cast<Vertex>(apex), {&only, 1}, one, shared, on_enter, on_leave);
  });
}

template <Field K>
template <class Visit>
void TriangleCochain<K>::for_each_row(Visit&& visit) const {
  for (std::size_t a = 0; a < at_.size(); ++a)
    bits::for_each(at_[a].present.data(), a / 64, at_[a].present.size(), [&](std::size_t b) {
      if (a < b) visit(static_cast<Vertex>(a), static_cast<Vertex>(b), at_[a].rows[b]);
    });
}

template <Field K>
void TriangleCochain<K>::drop_zero_rows(Shared& shared) {
  for_each_row([&](Vertex a, Vertex b, typename RowPool<K>::Id id) {
    if (!Function::is_zero(shared.rows[id], shared.blocks)) return;
    shared.rows.give(id);
    --row_count_;
    at_[a].present[b / 64] &= ~(Word{1} << (b % 64));
    at_[b].present[a / 64] &= ~(Word{1} << (a % 64));
  });
}

template <Field K>
template <class OnLeave>
void TriangleCochain<K>::clear(Shared& shared, OnLeave&& on_leave) {
  for_each_vertex(on_leave);
  lists_.clear(shared);
  for_each_row([&](Vertex, Vertex, auto id) { shared.rows.give(id); });
  *this = TriangleCochain(at_.get_allocator().resource());
}

template <Field K>
template <class Visit>
void TriangleCochain<K>::for_each_vertex(Visit&& visit) const {
  for (const auto& at : lists_.lists()) visit(at.vertex);
  for (std::size_t a = 0; a < at_.size(); ++a)
    if (!at_[a].present.empty()) visit(static_cast<Vertex>(a));
}

template <Field K>
template <class Visit>
void TriangleCochain<K>::for_each_triangle(const Shared& shared, Visit&& visit) const {
  for (const auto& [a, list] : lists_.lists())
    for (const Term& t : shared.lists[list])
      if (a < smaller(t)) visit(a, smaller(t), larger(t), t.coefficient());
  for_each_row([&](Vertex a, Vertex b, auto id) {
    Function::for_each(shared.rows[id], shared.blocks, [&](std::size_t c, Element value) {
      if (b < c) visit(a, b, static_cast<Vertex>(c), value);
    });
  });
}

}  // namespace ph
