// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/core/bit_matrix.hpp"
#include "ph/core/field.hpp"
#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"
#include "ph/engine/annotations.hpp"
#include "ph/engine/elder_rule.hpp"
#include "ph/engine/lens_components.hpp"
#include "ph/engine/lens_observer.hpp"
#include "ph/engine/lens_surfaces.hpp"

namespace ph {

/// H0, H1 and H2 of a Vietoris-Rips filtration edge by edge; no triangle is ever listed.
///
/// The triangles that enter with an edge e = (u,v) are those over its lens, the vertices joined to
/// both u and v before. All over one connected component of the lens say the same: one triangle a
/// component carries H1 (Koyama, Mémoli, Robins, Turner, Faster computation of degree-1 persistent
/// homology using the reduced Vietoris-Rips filtration). An empty lens lets e join two components
/// or give birth to a class. Otherwise the first triangle determines the annotation of e, and each
/// further component w asks that a(u,w) + a(w,v) be the same: where it is not, the youngest
/// generator of the difference dies. Almost all edges end sooner: if no edge between u or v and
/// the lens is active, that is, has an annotation, nothing can happen. Where a further component
/// kills nothing, a class of H2 is born; see LensSurfaces and docs/algorithms.md.
template <Field K>
class LensSweep {
 public:
  using Observer = LensObserver<K>;
  using Vertex = typename Observer::Vertex;
  using Position = typename Observer::Position;

  /// @param edges in the order of the filtration; they outlive the sweep.
  LensSweep(std::size_t vertices, std::span<const FlagEdge> edges, const K& field,
            LensWanted wanted, Observer& observer, const RunContext& context)
      : edges_(edges),
        field_(field),
        wanted_(wanted),
        observer_(observer),
        context_(context),
        joined_(vertices, vertices, &context.memory),
        active_(vertices, vertices, &context.memory),
        active_degree_(vertices, 0, &context.memory),
        lens_(joined_.words(), 0, &context.memory),
        components_(joined_, &context.memory),
        born_(&context.memory),
        sets_(vertices, &context.memory),
        annotations_(field, &context.memory),
        births_(&context.memory),
        cocycle_(&context.memory) {
    if (wanted.surfaces) surfaces_.emplace(joined_, field, wanted, observer, context);
  }

  void run();

 private:
  using Class = typename Annotations<K>::Class;
  using Triangle = typename Observer::Triangle;

  static constexpr Position kDead = UINT32_MAX;

  void add_edge(Position position);
  void join_or_give_birth(Position position, const FlagEdge& e);
  void report_zero_length(Position position, const FlagEdge& e);
  /// Gives the edge its class, and each further component of its lens what it causes.
  void annotate(Position position, const FlagEdge& e);
  /// @param of_edge the annotation that the last edge is about to get.
  void kill(Class relation, Triangle death, Class of_edge);
  void set_active(Vertex u, Vertex v);
  void set_inactive(Vertex u, Vertex v);
  /// cocycle_ = what a generator is on the edges before this one, if cocycles are wanted.
  void find_cocycle(typename Annotations<K>::Generator g);

  std::span<const FlagEdge> edges_;
  const K& field_;
  LensWanted wanted_;
  Observer& observer_;
  const RunContext& context_;
  BitMatrix joined_;  // edges so far
  BitMatrix active_;  // edges whose annotation is not zero
  std::pmr::vector<std::uint32_t> active_degree_;
  std::pmr::vector<BitMatrix::Word> lens_;
  LensComponents components_;           // of lens_
  std::pmr::vector<std::size_t> born_;  // components with which a class of H2 is born
  DisjointSets sets_;                   // each root is the oldest vertex of its component
  Annotations<K> annotations_;
  std::pmr::vector<Position> births_;  // by generator; kDead once it died
  std::pmr::vector<typename Observer::EdgeValue> cocycle_;
  std::optional<LensSurfaces<K>> surfaces_;
};

template <Field K>
void LensSweep<K>::run() {
  Ticker ticker(context_, "edges", edges_.size());
  for (Position position = 0; position < edges_.size(); ++position) {
    add_edge(position);
    ticker.tick();
  }
  for (std::uint32_t g = 0; g < births_.size(); ++g) {
    if (births_[g] == kDead) continue;
    find_cocycle(g);
    observer_.on_essential(births_[g], cocycle_);
  }
  if (surfaces_) surfaces_->finish();
}

template <Field K>
void LensSweep<K>::add_edge(Position position) {
  const FlagEdge& e = edges_[position];
  const auto *u = joined_.row(e.u), *v = joined_.row(e.v);
  const bool may_touch_active = active_degree_[e.u] != 0 || active_degree_[e.v] != 0;
  // One common neighbour says enough where nothing can happen.
  bits::Lens lens{};
  if (may_touch_active || surfaces_)
    lens = bits::lens(u, v, active_.row(e.u), active_.row(e.v), lens_.data(), joined_.words());
  else
    lens.is_empty = bits::first_common(u, v, joined_.words()) == bits::kNone;
  if (lens.is_empty) {
    join_or_give_birth(position, e);
  } else {
    if (wanted_.zero_length) report_zero_length(position, e);
    if (lens.touches_active || surfaces_) components_.find(e, lens_.data());
    born_.clear();
    if (lens.touches_active)
      annotate(position, e);
    else if (surfaces_)
      for (std::size_t i = 1; i < components_.count(); ++i) born_.push_back(i);
    if (surfaces_) {
      surfaces_->extend(position, e, lens_.data(), components_);
      for (const std::size_t i : born_)
        surfaces_->give_birth({position, components_.root(i)}, e, components_.vertices(i));
    }
  }
  joined_.set(e.u, e.v);
  joined_.set(e.v, e.u);
}

template <Field K>
void LensSweep<K>::report_zero_length(Position position, const FlagEdge& e) {
  const std::size_t first = bits::first_common(joined_.row(e.u), joined_.row(e.v), joined_.words());
  cocycle_.clear();
  if (wanted_.cocycles) cocycle_.push_back({position, field_.from_int(1)});
  observer_.on_death(position, {position, static_cast<Vertex>(first)}, cocycle_);
}

template <Field K>
void LensSweep<K>::join_or_give_birth(Position position, const FlagEdge& e) {
  const Vertex a = sets_.find(e.u), b = sets_.find(e.v);
  if (a != b) {
    sets_.link(std::max(a, b), std::min(a, b));
    observer_.on_join(std::min(a, b), std::max(a, b), position);
    return;
  }
  annotations_.add_generator({e.u, e.v, position});
  births_.push_back(position);
  set_active(e.u, e.v);
}

template <Field K>
void LensSweep<K>::annotate(Position position, const FlagEdge& e) {
  const auto around = [&](Vertex w) {
    return annotations_.sum(annotations_.of(e.u, w), annotations_.of(w, e.v));
  };
  Class value = around(components_.root(0));
  for (std::size_t i = 1; i < components_.count(); ++i) {
    const Class difference = annotations_.sum(around(components_.root(i)), -value);
    if (difference.is_zero()) {
      born_.push_back(i);
      continue;
    }
    kill(difference, {position, components_.root(i)}, value);
    value = around(components_.root(0));
  }
  if (value.is_zero()) return;
  annotations_.assign({e.u, e.v, position}, value);
  set_active(e.u, e.v);
}

template <Field K>
void LensSweep<K>::kill(Class relation, Triangle death, Class of_edge) {
  const auto g = annotations_.youngest(relation);
  find_cocycle(g);
  if (wanted_.cocycles) {
    const auto value = annotations_.value(of_edge, g);
    if (!field_.is_zero(value)) cocycle_.push_back({death.edge, value});
  }
  observer_.on_death(births_[g], death, cocycle_);
  births_[g] = kDead;
  annotations_.kill(relation, [&](const auto& edge) { set_inactive(edge.u, edge.v); });
}

template <Field K>
void LensSweep<K>::set_active(Vertex u, Vertex v) {
  active_.set(u, v);
  active_.set(v, u);
  ++active_degree_[u];
  ++active_degree_[v];
}

template <Field K>
void LensSweep<K>::set_inactive(Vertex u, Vertex v) {
  active_.clear(u, v);
  active_.clear(v, u);
  --active_degree_[u];
  --active_degree_[v];
}

template <Field K>
void LensSweep<K>::find_cocycle(typename Annotations<K>::Generator g) {
  cocycle_.clear();
  if (wanted_.cocycles)
    annotations_.for_each_value(g, [&](const auto& edge, typename K::Element a) {
      cocycle_.push_back({edge.position, a});
    });
}

extern template class LensSweep<Z2>;
extern template class LensSweep<Zp>;

}  // namespace ph
