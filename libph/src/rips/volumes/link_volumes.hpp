// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/rips/annotations/living_cocycles.hpp"
#include "libph/src/rips/sweep/link_components.hpp"
#include "libph/src/rips/sweep/link_cover.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "libph/src/rips/sweep/sweep_observer.hpp"
#include "libph/src/rips/volumes/link_primitives.hpp"
#include "libph/src/rips/volumes/tetrahedron_cochain.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Computes H3 of a Vietoris-Rips filtration edge by edge. This is the part of the sweep of edge
/// links that is needed for H3.
///
/// An edge e = (u,v) enters with its star, which is glued to the current complex along the
/// suspension of the flag complex M of its link. A class of H3 is therefore born with each class of
/// H^1(M), a *loop*, that kills no class of H2. A class of H3 dies with a class of H_2(M). Each
/// living class h is represented by a cocycle phi_h. To extend the cocycle to the new tetrahedra, a
/// 1-cochain psi(x,y) = phi_h(u,v,x,y) of M is needed, whose coboundary is gamma(x,y,z) :=
/// phi_h(u,x,y,z) - phi_h(v,x,y,z). If there is no such cochain, a class dies. See
/// docs/explanation/engines/edge-links-h3.md.
template <Field K>
class LinkVolumes {
 public:
  using Vertex = std::uint32_t;
  using Position = std::uint32_t;
  using Observer = SweepObserver<K>;
  using Tetrahedron = typename Observer::Tetrahedron;

  /// @param graph the edges so far; it must outlive this object.
  LinkVolumes(LinkGraph& graph, const K& field, Observer& observer, const RunContext& context)
      : graph_(graph),
        field_(field),
        observer_(observer),
        cocycles_(graph.vertex_count(), context, field),
        births_(&context.memory),
        cover_(graph, &context.memory),
        primitives_(graph, field, &context.memory),
        star_(&context.memory),
        dead_(&context.memory),
        loops_(&context.memory) {}

  /// Examines the edge whose link is stored in the graph. Finds the loops of the link and the
  /// extensions of the living classes. @param components the components of the link.
  void look(const FlagEdge& e, LinkComponents& components);
  /// A basis of H^1(M), valid until the next edge. The caller may add cocycles to its members.
  std::span<LinkPairs<K>* const> loops() const { return loops_; }
  /// Adds a class that is born with a tetrahedron over the edge. The value of the loop on that
  /// tetrahedron must be one.
  void give_birth(Tetrahedron birth, const FlagEdge& e, const LinkPairs<K>& loop);
  /// Extends the living classes to the star of the edge, and kills classes that cannot be extended.
  void extend(Position position, const FlagEdge& e);
  /// Reports the classes that never die.
  void finish();

 private:
  using Cochain = TetrahedronCochain<K>;
  using Cocycles = LivingCocycles<Cochain>;
  using Generator = typename Cocycles::Generator;
  using Search = typename LinkPrimitives<K>::Search;
  using Element = typename K::Element;

  static constexpr Position kDead = UINT32_MAX;

  /// Begins a search for each class whose gamma is not zero.
  void find_classes(const FlagEdge& e);
  /// Computes gamma += scale * phi_h(a,.,.,.), restricted to the link. @param terms the list of a.
  void add_terms(LinkTriples<K>& gamma, typename Cochain::Terms terms, Element scale);
  /// Computes phi_h(u,v,.,.) += psi.
  void store(Generator h, const FlagEdge& e, const LinkPairs<K>& psi);

  LinkGraph& graph_;
  const K& field_;
  Observer& observer_;
  Cocycles cocycles_;
  std::pmr::vector<Tetrahedron> births_;  // birth of each generator; edge = kDead after its death
  // The following members are used while an edge is added.
  LinkCover cover_;
  LinkPrimitives<K> primitives_;
  std::pmr::vector<typename Cochain::PairValue> star_;
  std::pmr::vector<Generator> dead_;
  std::pmr::vector<LinkPairs<K>*> loops_;
};

template <Field K>
void LinkVolumes<K>::look(const FlagEdge& e, LinkComponents& components) {
  primitives_.clear();
  loops_.clear();
  find_classes(e);
  if (!components.has_apex() && components.count() == 1) components.find_apex(e);
  if (components.has_apex() && primitives_.all().empty()) return;
  cover_.find(components);
  primitives_.search(cover_);
  for (Search* s : primitives_.all())
    if (s->is_loop() && s->is_active) loops_.push_back(&s->psi);  // mutant: volume-loop-active
}

template <Field K>
void LinkVolumes<K>::find_classes(const FlagEdge& e) {
  using At = typename Cocycles::At;
  cocycles_.for_each_at(e.u, e.v, [&](Generator h, const At* at_u, const At* at_v) {
    Search& s = primitives_.add(h);
    if (at_u != nullptr) add_terms(s.gamma, cocycles_.terms(*at_u), field_.from_int(1));
    // mutant: volume-gamma
    if (at_v != nullptr) add_terms(s.gamma, cocycles_.terms(*at_v), field_.from_int(-1));
    if (s.gamma.is_zero(graph_.words())) primitives_.drop_last();
  });
}

template <Field K>
void LinkVolumes<K>::add_terms(LinkTriples<K>& gamma, typename Cochain::Terms terms,
                               Element scale) {
  for (const auto& t : terms) {
    const auto [a, b, c] = Cochain::others(t);
    const Vertex x = graph_.local(a), y = graph_.local(b), z = graph_.local(c);
    if (x == LinkGraph::kNone || y == LinkGraph::kNone || z == LinkGraph::kNone) continue;
    gamma.add_at(x, y, z, field_.multiply(scale, t.coefficient()));
  }
}

template <Field K>
void LinkVolumes<K>::store(Generator h, const FlagEdge& e, const LinkPairs<K>& psi) {
  star_.clear();
  psi.for_each(graph_.words(), [&](Vertex x, Vertex y, Element a) {
    star_.push_back({graph_.global(x), graph_.global(y), a});
  });
  if (!star_.empty()) cocycles_.add_star(h, e.u, e.v, star_);
}

template <Field K>
void LinkVolumes<K>::give_birth(Tetrahedron birth, const FlagEdge& e, const LinkPairs<K>& loop) {
  const Generator h = cocycles_.add_generator();
  births_.push_back(birth);
  store(h, e, loop);
}

template <Field K>
void LinkVolumes<K>::extend(Position position, const FlagEdge& e) {
  bool is_obstructed = false;
  for (const Search* s : primitives_.all()) is_obstructed |= s->is_obstructed;
  if (is_obstructed) {
    dead_.clear();
    primitives_.search_in_order(
        [&](const Search& s, Vertex z, Vertex y, Vertex w) {
          observer_.on_death(births_[s.generator],
                             {position, {graph_.global(z), graph_.global(y), graph_.global(w)}});
          births_[s.generator].edge = kDead;
          dead_.push_back(s.generator);
        },
        [&](const Search& s, const Search& other, Element scale) {
          cocycles_.add(s.generator, other.generator, scale);  // mutant: volume-corrected
        });
    for (const Generator h : dead_) cocycles_.erase(h);  // mutant: volume-dead
  }
  for (const Search* s : primitives_.all())
    if (s->is_found) store(s->generator, e, s->psi);
}

template <Field K>
void LinkVolumes<K>::finish() {
  for (const Tetrahedron& birth : births_)
    if (birth.edge != kDead) observer_.on_essential(birth);
}

extern template class LinkVolumes<Z2>;
extern template class LinkVolumes<Zp>;

}  // namespace ph
