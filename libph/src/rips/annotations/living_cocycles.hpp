// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/run_context.hpp"

namespace ph {

/// The living classes of cohomology, given by their cocycles. For each vertex, this class stores
/// the cohomology classes whose cocycles are not zero on some simplex at that vertex.
/// @tparam Cochain a type such as TriangleCochain.
template <class Cochain>
class LivingCocycles {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth
  using Vertex = std::uint32_t;
  using Element = typename Cochain::Element;
  using ListId = typename Cochain::ListId;
  /// A generator whose cocycle may be non-zero on simplices at a vertex, with the list of these
  /// simplices unless the cocycle is dense.
  struct At {
    Generator generator;
    ListId list;
  };

  /// @param shared the arguments of the constructor of `Cochain::Shared`, except the memory.
  template <class... Arguments>
  LivingCocycles(std::size_t vertices, const RunContext& context, const Arguments&... shared)
      : context_(context),
        shared_(shared..., &context.memory),
        cochains_(&context.memory),
        at_(vertices, &context.memory) {}

  Generator add_generator() {
    cochains_.emplace_back(&context_.memory);
    ++shared_.living;
    return static_cast<Generator>(cochains_.size() - 1);
  }
  void erase(Generator g);
  /// Computes to += scale * from.
  void add(Generator to, Generator from, Element scale);
  /// Calls Cochain::add_star for the cocycle of g.
  template <class Star>
  void add_star(Generator g, Vertex u, Vertex v, const Star& star);

  /// Calls `visit(generator, at_u, at_v)` for each generator that may have simplices at u or v, in
  /// ascending order. If a generator has no simplices at u, `at_u` is null. If it has no simplices
  /// at v, `at_v` is null.
  template <class Visit>
  void for_each_at(Vertex u, Vertex v, Visit&& visit) const;
  /// The terms in the list. There are no terms if the cocycle is dense.
  typename Cochain::Terms terms(const At& at) const {
    using Terms = typename Cochain::Terms;
    return cochains_[at.generator].is_dense() ? Terms() : Terms(shared_.lists[at.list]);
  }
  const Cochain& operator[](Generator g) const { return cochains_[g]; }
  const typename Cochain::Shared& shared() const { return shared_; }

 private:
  auto place(Generator g, Vertex a) {
    return std::ranges::lower_bound(at_[a], g, {}, &At::generator);
  }
  void enter(Generator g, Vertex a, ListId list) { at_[a].insert(place(g, a), At{g, list}); }
  void leave(Generator g, Vertex a) { at_[a].erase(place(g, a)); }

  const RunContext& context_;
  typename Cochain::Shared shared_;
  std::pmr::vector<Cochain> cochains_;
  std::pmr::vector<std::pmr::vector<At>> at_;
};

template <class Cochain>
template <class Visit>
void LivingCocycles<Cochain>::for_each_at(Vertex u, Vertex v, Visit&& visit) const {
  auto i = at_[u].begin(), j = at_[v].begin();
  const auto end_i = at_[u].end(), end_j = at_[v].end();
  while (i != end_i || j != end_j) {
    const bool is_at_u = i != end_i && (j == end_j || i->generator <= j->generator);
    // mutant: surface-ends
    const bool is_at_v = j != end_j && (i == end_i || j->generator <= i->generator);
    const At* at_u = is_at_u ? &*i++ : nullptr;
    const At* at_v = is_at_v ? &*j++ : nullptr;
    visit((is_at_u ? at_u : at_v)->generator, at_u, at_v);
  }
}

template <class Cochain>
void LivingCocycles<Cochain>::erase(Generator g) {
  cochains_[g].clear(shared_, [&](Vertex a) { leave(g, a); });
  --shared_.living;
}

template <class Cochain>
void LivingCocycles<Cochain>::add(Generator to, Generator from, Element scale) {
  context_.poll();  // adding a large cocycle takes a long time
  cochains_[to].add(
      cochains_[from], scale, shared_, [&](Vertex a, ListId list) { enter(to, a, list); },
      [&](Vertex a) { leave(to, a); });
}

template <class Cochain>
template <class Star>
void LivingCocycles<Cochain>::add_star(Generator g, Vertex u, Vertex v, const Star& star) {
  cochains_[g].add_star(u, v, star, shared_, [&](Vertex a, ListId list) { enter(g, a, list); });
}

}  // namespace ph
