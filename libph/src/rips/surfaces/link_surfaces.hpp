// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <memory_resource>
#include <vector>

#include "libph/src/rips/surfaces/link_extensions.hpp"
#include "libph/src/rips/sweep/link_components.hpp"
#include "libph/src/rips/sweep/link_cover.hpp"
#include "libph/src/rips/sweep/link_forest.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "libph/src/rips/sweep/sweep_observer.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Computes H2 of a Vietoris-Rips filtration edge by edge. This is the part of the sweep of edge
/// links that is needed for H2.
///
/// An edge e = (u,v) enters with its star, which is glued to the current complex along the
/// suspension of e's link, a flag complex. A class of H2 is therefore born with each component of
/// the link except the first, unless the component kills a class of H1. A class of H2 dies with a
/// loop of the link. Each living class h is represented by a cocycle phi_h. To extend the cocycle
/// to the new triangles, a potential is needed. A potential is a function p(w) = phi_h(u,v,w) on
/// the vertices of the link for which p(y) - p(x) = gamma(x,y) := phi_h(u,x,y) - phi_h(v,x,y) for
/// each edge xy of the link. If there is no potential, a class dies. See
/// docs/explanation/engines/edge-links-h2.md.
template <Field K>
class LinkSurfaces {
 public:
  using Vertex = std::uint32_t;
  using Position = std::uint32_t;
  using Element = typename K::Element;
  using Word = bits::Word;
  using Observer = SweepObserver<K>;
  using Triangle = typename Observer::Triangle;

  /// @param graph the edges so far; it must outlive this object.
  LinkSurfaces(LinkGraph& graph, const K& field, SweepRequest wanted, Observer& observer,
               const RunContext& context)
      : graph_(graph),
        field_(field),
        wanted_(wanted),
        observer_(observer),
        cocycles_(graph.vertex_count(), context, field, graph.vertex_count(),
                  wanted.tuning.most_terms * graph.vertex_count()),
        births_(&context.memory),
        cover_(graph, &context.memory),
        forest_(graph, &context.memory),
        extensions_(cocycles_, graph, field, &context.memory),
        births_above_(&context.memory),
        partners_(&context.memory),
        star_((graph.vertex_count() + 63) / 64 * Function::kUnitsPerBlock, 0, &context.memory),
        own_star_(star_.size(), 0, &context.memory),
        cocycle_(&context.memory) {}

  /// The birth of a class of H3: a cocycle of a link that kills no class of H2, and the first
  /// tetrahedron at which this cocycle stops being a coboundary.
  struct BirthAbove {
    typename Observer::Tetrahedron birth;
    LinkPairs<K>* loop;
  };

  /// Extends the living classes to the star of the edge whose link is stored in the graph, and
  /// kills classes that cannot be extended.
  /// @param loops a basis of H^1 of the link, if births of H3 are wanted; the call may add other
  /// cocycles to its members.
  void extend(Position position, const FlagEdge& e, LinkComponents& components,
              std::span<LinkPairs<K>* const> loops = {});
  /// The births of H3 with the last edge.
  std::span<const BirthAbove> births_above() const { return births_above_; }
  /// Adds a class that is born with a component of an edge's link.
  void give_birth(Triangle birth, const FlagEdge& e, const Word* component);
  /// Reports the classes that never die.
  void finish();

 private:
  using Cocycles = typename LinkExtensions<K>::Cocycles;
  using Generator = typename Cocycles::Generator;
  using Extension = typename LinkExtensions<K>::Extension;
  using Function = VertexFunction<K>;
  using Unit = typename Function::Unit;

  static constexpr Position kDead = UINT32_MAX;

  /// Goes through a link in the order of the tetrahedra over the edge. Each obstructed class either
  /// dies or is changed until it is no longer obstructed.
  /// @param is_extended true if only pairs of length zero are left to find.
  void sweep(Position position, const FlagEdge& e, bool is_extended);
  void kill_mismatched(Position position, const FlagEdge& e, Vertex y);
  /// The value that the edge to w requires for the last vertex, minus the value of the extension at
  /// this vertex.
  Element mismatch_of(const Extension& x, Vertex w);
  /// Adds younger classes to the classes that are mismatched at w. Afterwards, only the youngest of
  /// these classes, which is the dying class, has a mismatch at w. @param words the number of words
  /// in use per row.
  void correct_others(std::size_t dying, const FlagEdge& e, Vertex w, std::size_t words);
  /// Reports a pair of length zero, whose death is a tetrahedron that joins two parts of the link.
  /// @param root, part the root and the vertices of one of these parts.
  void report_zero_length(const FlagEdge& e, Vertex root, const Word* part,
                          typename Observer::Tetrahedron tetrahedron);
  void store(const Extension& x, const FlagEdge& e, const LinkComponents& components);
  /// Computes phi_h(u,v,.) += star, where `star` is a function on the link.
  void add_star(Generator h, const FlagEdge& e, const Unit* star);
  void find_cocycle(Generator h);
  /// Adds phi(u,v,.) to cocycle_. @param star its values, in the first `words` words.
  void add_star_to_cocycle(const FlagEdge& e, const Unit* star, std::size_t words);

  LinkGraph& graph_;
  const K& field_;
  SweepRequest wanted_;
  Observer& observer_;
  Cocycles cocycles_;
  std::pmr::vector<Triangle> births_;  // birth of each generator; edge = kDead after its death
  // The following members are used while an edge is added.
  LinkCover cover_;
  LinkForest forest_;
  LinkExtensions<K> extensions_;
  std::pmr::vector<BirthAbove> births_above_;
  std::pmr::vector<std::size_t> partners_;  // for each extension, the extension to be added to it
  std::pmr::vector<Unit> star_;             // values on the link
  std::pmr::vector<Unit> own_star_;         // values on all vertices; all are zero between uses
  std::pmr::vector<typename Observer::TriangleValue> cocycle_;
};

template <Field K>
void LinkSurfaces<K>::give_birth(Triangle birth, const FlagEdge& e, const Word* component) {
  const Generator h = cocycles_.add_generator();
  births_.push_back(birth);
  std::fill_n(star_.begin(), graph_.words() * Function::kUnitsPerBlock, Unit{});
  Function::shift(star_.data(), component, field_.from_int(1), field_, graph_.words());
  add_star(h, e, star_.data());
}

template <Field K>
void LinkSurfaces<K>::add_star(Generator h, const FlagEdge& e, const Unit* star) {
  if (graph_.keeps_numbers()) return cocycles_.add_star(h, e.u, e.v, star);
  const auto own = [&](std::size_t w) { return graph_.global(static_cast<Vertex>(w)); };
  Function::for_each(star, graph_.words(), [&](std::size_t w, Element a) {
    Function::add_at(own_star_.data(), own(w), a, field_);
  });
  cocycles_.add_star(h, e.u, e.v, own_star_.data());
  Function::for_each(star, graph_.words(), [&](std::size_t w, Element a) {
    Function::add_at(own_star_.data(), own(w), field_.negate(a), field_);
  });
}

template <Field K>
void LinkSurfaces<K>::finish() {
  for (Generator h = 0; h < births_.size(); ++h) {
    if (births_[h].edge == kDead) continue;
    find_cocycle(h);
    observer_.on_essential(births_[h], cocycle_);
  }
}

template <Field K>
void LinkSurfaces<K>::extend(Position position, const FlagEdge& e, LinkComponents& components,
                             std::span<LinkPairs<K>* const> loops) {
  births_above_.clear();
  const bool is_obstructed = extensions_.find(e, [&]() -> const LinkCover& {
    if (!components.has_apex() && components.count() == 1) components.find_apex(e);
    cover_.find(components);
    return cover_;
  });
  extensions_.add_loops(loops);
  if (is_obstructed || !loops.empty()) sweep(position, e, false);
  if (wanted_.zero_length) sweep(position, e, true);
  for (const Extension& x : extensions_.all())
    if (x.loop == nullptr) store(x, e, components);
  extensions_.clear();
}

template <Field K>
void LinkSurfaces<K>::sweep(Position position, const FlagEdge& e, bool is_extended) {
  const Word* link = graph_.link();
  forest_.clear();
  bits::for_each(link, 0, graph_.words(), [&](std::size_t vertex) {
    const auto y = static_cast<Vertex>(vertex);
    forest_.meet(y, link);
    bool is_mismatched = false;
    if (!is_extended && !forest_.meetings().empty())
      for (Extension& x : extensions_.all())
        if (x.is_obstructed) is_mismatched |= extensions_.extend_to(x, e, y, forest_);
    if (is_mismatched) kill_mismatched(position, e, y);
    forest_.join(y, [&](Vertex root, const Word* part, Vertex w) {
      if (is_extended)
        report_zero_length(e, root, part, {position, graph_.global(y), graph_.global(w)});
    });
  });
}

template <Field K>
auto LinkSurfaces<K>::mismatch_of(const Extension& x, Vertex w) -> Element {
  return x.is_mismatched ? Function::value(extensions_.mismatch(x), w) : field_.from_int(0);
}

template <Field K>
void LinkSurfaces<K>::kill_mismatched(Position position, const FlagEdge& e, Vertex y) {
  const std::size_t words = LinkForest::words_to(y);
  auto& all = extensions_.all();
  for (Vertex from = 0;;) {
    // The first tetrahedron across which some classes do not extend kills the youngest of these
    // classes.
    std::size_t first = bits::kNone;
    for (const Extension& x : all)
      if (x.is_mismatched)
        first = std::min(first, Function::first(extensions_.mismatch(x), from, words));
    if (first == bits::kNone) break;
    const auto w = static_cast<Vertex>(first);
    from = w + 1;
    const auto dying = std::prev(std::ranges::find_if(all.rbegin(), all.rend(), [&](const auto& x) {
                                   return !field_.is_zero(mismatch_of(x, w));
                                 }).base());
    const typename Observer::Tetrahedron tetrahedron{position, graph_.global(y), graph_.global(w)};
    const auto place = static_cast<std::size_t>(dying - all.begin());
    if (dying->loop != nullptr) {
      births_above_.push_back({tetrahedron, dying->loop});  // mutant: volume-birth-above
      correct_others(place, e, w, words);
    } else {
      const Generator h = dying->generator;
      find_cocycle(h);
      if (wanted_.cocycles) add_star_to_cocycle(e, extensions_.potential(*dying), words);
      observer_.on_death(births_[h], tetrahedron, cocycle_);
      births_[h].edge = kDead;  // mutant: surface-dead
      correct_others(place, e, w, words);
      cocycles_.erase(h);
    }
    extensions_.remove(&*dying);
    extensions_.refresh(e);
  }
  for (Extension& x : all) x.is_mismatched = false;
}

template <Field K>
void LinkSurfaces<K>::correct_others(std::size_t dying, const FlagEdge& e, Vertex w,
                                     std::size_t words) {
  // A multiple of a younger mismatched class is added to each other mismatched extension. Among the
  // younger classes, the class whose cocycle was smallest before this step is used. Loops come
  // before all classes.
  auto& all = extensions_.all();
  partners_.assign(dying, dying);
  std::size_t partner = dying;
  for (std::size_t i = dying; i-- > 0;) {
    partners_[i] = partner;
    const auto size_of = [&](std::size_t k) { return cocycles_[all[k].generator].size(); };
    if (all[i].loop != nullptr) continue;
    if (!field_.is_zero(mismatch_of(all[i], w)) && size_of(i) < size_of(partner)) partner = i;
  }
  for (std::size_t i = 0; i < dying; ++i) {  // mutant: surface-dying
    Extension &x = all[i], &y = all[partners_[i]];
    const Element a = mismatch_of(x, w);
    if (field_.is_zero(a)) continue;
    const Element scale = field_.negate(field_.multiply(a, field_.inverse(mismatch_of(y, w))));
    if (x.loop != nullptr)
      extensions_.add_gamma(*x.loop, y, e, scale);  // mutant: volume-loop-gamma
    else
      cocycles_.add(x.generator, y.generator, scale);  // mutant: surface-corrected
    Function::add(extensions_.potential(x), extensions_.potential(y), scale, field_, words);
    Function::add(extensions_.mismatch(x), extensions_.mismatch(y), scale, field_, words);
    x.is_flat = false;
  }
}

template <Field K>
void LinkSurfaces<K>::report_zero_length(const FlagEdge& e, Vertex root, const Word* part,
                                         typename Observer::Tetrahedron tetrahedron) {
  cocycle_.clear();
  if (wanted_.cocycles) {
    std::fill_n(star_.begin(), graph_.words() * Function::kUnitsPerBlock, Unit{});
    Function::shift(star_.data(), part, field_.from_int(1), field_, graph_.words());
    add_star_to_cocycle(e, star_.data(), graph_.words());
  }
  observer_.on_death({tetrahedron.edge, graph_.global(root)}, tetrahedron, cocycle_);
}

template <Field K>
void LinkSurfaces<K>::store(const Extension& x, const FlagEdge& e,
                            const LinkComponents& components) {
  // A constant may be subtracted from the potential on a component, because this changes the class
  // only by younger classes. The constants are chosen to leave few values to store.
  Unit* p = extensions_.potential(x);
  const std::size_t words = graph_.words();
  for (std::size_t i = 0; i < components.count(); ++i) {
    const Word* set = components.count() == 1 ? graph_.link() : components.vertices(i);
    const Element most = Function::majority(p, set, field_, words);
    if (!field_.is_zero(most)) Function::shift(p, set, field_.negate(most), field_, words);
  }
  if (!Function::is_zero(p, words)) add_star(x.generator, e, p);
}

template <Field K>
void LinkSurfaces<K>::find_cocycle(Generator h) {
  cocycle_.clear();
  if (wanted_.cocycles)
    cocycles_[h].for_each_triangle(cocycles_.shared(),
                                   [&](Vertex a, Vertex b, Vertex c, Element value) {
                                     cocycle_.push_back({{a, b, c}, value});
                                   });
}

template <Field K>
void LinkSurfaces<K>::add_star_to_cocycle(const FlagEdge& e, const Unit* star, std::size_t blocks) {
  Function::for_each(star, blocks, [&](std::size_t apex, Element a) {
    std::array<Vertex, 3> vertices{e.v, e.u, graph_.global(static_cast<Vertex>(apex))};
    // The sign of phi(u,v,w) changes if sorting (u,v,w) needs an odd number of swaps.
    const bool is_odd = vertices[2] > e.u || vertices[2] < e.v;
    std::ranges::sort(vertices);
    cocycle_.push_back({vertices, is_odd ? field_.negate(a) : a});
  });
}

extern template class LinkSurfaces<Z2>;
extern template class LinkSurfaces<Zp>;

}  // namespace ph
