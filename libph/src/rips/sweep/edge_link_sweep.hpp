// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/components/elder_rule.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/rips/binned_edges.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"
#include "rips/annotations/annotations.hpp"
#include "rips/relations/formal_annotations.hpp"
#include "rips/surfaces/link_surfaces.hpp"
#include "rips/sweep/link_components.hpp"
#include "rips/sweep/link_cycles.hpp"
#include "rips/sweep/link_graph.hpp"
#include "rips/sweep/sweep_observer.hpp"

namespace ph {

/// H0, H1 and H2 of a Vietoris-Rips filtration edge by edge; no triangle is ever listed.
///
/// The triangles that enter with an edge e = (u,v) are those over its link, the vertices joined to
/// both u and v before. All over one connected component of the link say the same: one triangle a
/// component carries H1 (Koyama, Mémoli, Robins, Turner, Faster computation of degree-1 persistent
/// homology using the reduced Vietoris-Rips filtration). An empty link lets e join two components
/// or give birth to a class. Otherwise the first triangle determines the annotation of e, and each
/// further component w asks that a(u,w) + a(w,v) be the same: where it is not, the youngest
/// generator of the difference dies. Almost all edges end sooner: if no edge between u or v and
/// the link is active, that is, has an annotation, nothing can happen. Where a further component
/// kills nothing, a class of H2 is born; see LinkSurfaces and docs/algorithms/edge-links.md.
template <Field K>
class EdgeLinkSweep {
 public:
  using Observer = SweepObserver<K>;
  using Vertex = typename Observer::Vertex;
  using Position = typename Observer::Position;

  /// @param births of the vertices; empty: all enter first. @param edges outlive the sweep; those
  /// after which nothing happens are never sorted.
  EdgeLinkSweep(std::size_t vertices, std::span<const double> births, const BinnedEdges& edges,
                const K& field, SweepRequest wanted, Observer& observer, const RunContext& context)
      : edges_(edges),
        field_(field),
        wanted_(wanted),
        observer_(observer),
        context_(context),
        layout_(wanted.tuning.layout == LinkLayout::automatic
                    ? LinkGraph::choose_layout(vertices, edges.size())
                    : wanted.tuning.layout),
        active_(vertices,
                layout_ == LinkLayout::rows && vertices <= wanted.tuning.vertices_of_active_rows,
                &context.memory),
        graph_(active_, edges, layout_, &context.memory),
        components_(graph_, &context.memory),
        born_(&context.memory),
        age_(vertex_ages(vertices, births, &context.memory)),
        sets_(vertices, &context.memory),
        births_(&context.memory),
        living_for_formal_(wanted.tuning.classes_for_formal),
        representative_(&context.memory) {
    annotations_ =
        std::make_unique<Annotations<K>>(field, active_, wanted.cocycles, &context.memory);
    if (wanted.cycles) cycles_.emplace(graph_, *annotations_, field, &context.memory);
    if (wanted.surfaces) surfaces_.emplace(graph_, field, wanted, observer, context);
  }

  void run();

 private:
  using Class = typename Annotations<K>::Class;
  using Triangle = typename Observer::Triangle;

  static constexpr Position kDead = UINT32_MAX;

  /// Whether an edge does something only if its link is empty.
  bool can_skip_bins() const { return !surfaces_ && !wanted_.zero_length && living_ == 0; }
  /// Whether nothing happens at the edges of a bin. They are not added, see first_unadded_bin_.
  bool can_skip_bin(std::size_t bin);
  /// Adds the edges of skipped bins.
  void add_bins_until(std::size_t bin);
  void add_edge(Position position);
  void join_or_give_birth(Position position, const FlagEdge& e);
  void report_zero_length(Position position, const FlagEdge& e);
  /// Gives the edge its class, and each further component of its link what it causes.
  void annotate(Position position, const FlagEdge& e);
  /// The same where many classes live.
  void annotate_formally(Position position, const FlagEdge& e);
  /// Whether there are many, and no more is wanted than when they die.
  bool wants_formal() const {
    return std::same_as<K, Z2> && living_ >= living_for_formal_ && layout_ == LinkLayout::rows &&
           !surfaces_ && !wanted_.cycles && !wanted_.cocycles &&
           graph_.vertex_count() <= wanted_.tuning.vertices_of_active_rows &&
           FormalAnnotations::bytes(graph_.vertex_count()) <= most_bytes_for_formal();
  }
  double most_bytes_for_formal() const {
    constexpr double most = 1 << 29, share = 0.25;  // of what memory is left
    return std::min(most, share * static_cast<double>(context_.memory.left()));
  }
  void begin_formal();
  auto report_death() {
    return [this](Position birth, const FormalAnnotations::Triangle& death) {
      observer_.on_death(birth, Triangle{death.edge, death.apex}, {});
      --living_;
    };
  }
  void solve_relations();
  void end_formal();
  /// births_ = those of the living.
  void take_births();
  /// @param of_edge the annotation that the last edge is about to get.
  void kill(Class relation, Triangle death, Class of_edge);
  /// representative_ = what a generator is on the edges before this one, if cocycles are wanted,
  /// and the cycle with these values of the generators, or those of a class, if cycles are.
  template <class Values>
  void find_representative(typename Annotations<K>::Generator g, Values of_cycle);

  const BinnedEdges& edges_;
  const K& field_;
  SweepRequest wanted_;
  Observer& observer_;
  const RunContext& context_;
  const LinkLayout layout_;
  ActiveEdges active_;         // of non-zero annotation
  LinkGraph graph_;            // edges so far, but for the skipped bins from first_unadded_bin_ on
  LinkComponents components_;  // of the graph's link
  std::pmr::vector<std::size_t> born_;  // components with which a class of H2 is born
  std::size_t first_unadded_bin_ = 0;
  std::size_t living_ = 0;               // classes of H1
  std::pmr::vector<std::uint32_t> age_;  // by vertex
  DisjointSets sets_;                    // each root is the oldest vertex of its component
  std::unique_ptr<Annotations<K>> annotations_;
  std::pmr::vector<Position> births_;          // by generator; kDead once it died
  std::unique_ptr<FormalAnnotations> formal_;  // has both instead, while there are many
  std::size_t living_for_formal_;
  std::optional<LinkCycles<K>> cycles_;
  std::pmr::vector<typename Observer::EdgeValue> representative_;
  std::optional<LinkSurfaces<K>> surfaces_;
};

template <Field K>
void EdgeLinkSweep<K>::run() {
  Ticker ticker(context_, "edges", edges_.size());
  for (std::size_t bin = 0; bin < edges_.bin_count(); ++bin) {
    const std::size_t begin = edges_.bin_begin(bin), end = edges_.bin_begin(bin + 1);
    if (can_skip_bin(bin)) {
      ticker.tick(end - begin);
      continue;
    }
    add_bins_until(bin);
    edges_.sorted_bins(bin + 1);
    if (!can_skip_bins() && thread_count(context_) > 1) edges_.sort_ahead(bin + 1);
    for (std::size_t position = begin; position < end; ++position) {
      add_edge(static_cast<Position>(position));
      ticker.tick();
    }
    first_unadded_bin_ = bin + 1;
  }
  if (formal_) {
    if (formal_->has_rows()) formal_->solve(report_death());
    take_births();
  }
  for (std::uint32_t g = 0; g < births_.size(); ++g) {
    if (births_[g] == kDead) continue;
    find_representative(g, g);
    observer_.on_essential(births_[g], representative_);
  }
  if (surfaces_) surfaces_->finish();
}

template <Field K>
bool EdgeLinkSweep<K>::can_skip_bin(std::size_t bin) {
  // A link that is not empty stays so, and its edge joins no components.
  if (!can_skip_bins()) return false;
  const auto have_links = [&](std::span<const FlagEdge> edges) {
    return graph_.have_links(edges, context_);
  };
  if (edges_.with_bins(bin, bin + 1, have_links)) return true;
  if (first_unadded_bin_ == bin) return false;
  add_bins_until(bin);
  return edges_.with_bins(bin, bin + 1, have_links);
}

template <Field K>
void EdgeLinkSweep<K>::add_bins_until(std::size_t bin) {
  edges_.with_bins(first_unadded_bin_, bin,
                   [&](std::span<const FlagEdge> edges) { graph_.add_all(edges, context_); });
  first_unadded_bin_ = bin;
}

template <Field K>
void EdgeLinkSweep<K>::add_edge(Position position) {
  const FlagEdge& e = edges_[position];
  const bool wants_graph = surfaces_ || wanted_.zero_length;
  const LinkGraph::Link link = graph_.find_link(e, wants_graph || formal_);
  if (link.is_empty) {
    join_or_give_birth(position, e);
  } else {
    if (wanted_.zero_length) report_zero_length(position, e);
    if ((link.touches_active || surfaces_) && !formal_) components_.find(e);
    born_.clear();
    if (formal_)
      annotate_formally(position, e);
    else if (link.touches_active)
      annotate(position, e);
    else if (surfaces_)
      for (std::size_t i = 1; i < components_.count(); ++i) born_.push_back(i);
    if (surfaces_) {
      surfaces_->extend(position, e, components_);
      for (const std::size_t i : born_)
        surfaces_->give_birth({position, graph_.global(components_.root(i))}, e,
                              components_.vertices(i));
    }
  }
  graph_.add(e);
}

template <Field K>
void EdgeLinkSweep<K>::report_zero_length(Position position, const FlagEdge& e) {
  const Vertex apex = graph_.global(graph_.first());
  representative_.clear();
  if (wanted_.cocycles || wanted_.cycles) representative_.push_back({position, field_.from_int(1)});
  if (wanted_.cycles)  // u to v to the apex to u, and u > v
    for (const auto& [from, to] : {std::pair{e.v, apex}, std::pair{apex, e.u}})
      representative_.push_back(
          {observer_.position_of(from, to), field_.from_int(from > to ? 1 : -1)});
  observer_.on_death(position, {position, apex}, representative_);
}

template <Field K>
void EdgeLinkSweep<K>::join_or_give_birth(Position position, const FlagEdge& e) {
  Vertex elder = sets_.find(e.u), younger = sets_.find(e.v);
  if (elder != younger) {
    if (age_[younger] < age_[elder]) std::swap(elder, younger);
    sets_.link(younger, elder);
    observer_.on_join(elder, younger, position);
    return;
  }
  ++living_;
  if (formal_) return formal_->give_birth({e.u, e.v, position});
  if (cycles_) cycles_->add(e.u, e.v);
  annotations_->add_generator({e.u, e.v, position});
  births_.push_back(position);
  if (wants_formal()) begin_formal();
}

template <Field K>
void EdgeLinkSweep<K>::annotate(Position position, const FlagEdge& e) {
  const auto around = [&](Vertex w) {
    return annotations_->sum(annotations_->of(e.u, w), annotations_->of(w, e.v));
  };
  const Vertex first = graph_.global(components_.root(0));
  Class value = around(first);
  for (std::size_t i = 1; i < components_.count(); ++i) {
    const Vertex root = graph_.global(components_.root(i));
    const Class difference = annotations_->sum(around(root), -value);
    if (difference.is_zero()) {
      born_.push_back(i);
      continue;
    }
    kill(difference, {position, root}, value);
    value = around(first);
  }
  if (!value.is_zero()) annotations_->assign({e.u, e.v, position}, value);
}

template <Field K>
void EdgeLinkSweep<K>::annotate_formally(Position position, const FlagEdge& e) {
  bits::for_each(graph_.link(), 0, graph_.words(),
                 [&](std::size_t w) { formal_->prefetch_path(e.u, static_cast<Vertex>(w), e.v); });
  components_.find_roots(e);
  const auto around = [&](std::size_t i) {
    return formal_->path(e.u, graph_.global(components_.root(i)), e.v);
  };
  for (std::size_t i = 0; i < components_.count(); ++i) formal_->prefetch(around(i));
  for (std::size_t i = 1; i < components_.count(); ++i)
    formal_->relate(around(i), around(0), {position, graph_.global(components_.root(i))},
                    report_death());
  formal_->assign({e.u, e.v, position}, formal_->sum(around(0)));
  if (formal_->is_due()) solve_relations();
}

template <Field K>
void EdgeLinkSweep<K>::begin_formal() {
  if constexpr (std::same_as<K, Z2>) {
    std::pmr::vector<FormalAnnotations::Generator> numbers(births_.size(), 0, &context_.memory),
        sum(&context_.memory);
    formal_ = std::make_unique<FormalAnnotations>(
        graph_.vertex_count(), wanted_.tuning.relations_for_formal, &context_.memory);
    for (std::size_t g = 0; g < births_.size(); ++g)
      if (births_[g] != kDead) numbers[g] = formal_->add_generator(births_[g]);
    annotations_->for_each_edge([&](const auto& edge, const auto& terms) {
      sum.clear();
      for (const auto& t : terms) sum.push_back(numbers[t.cell]);
      formal_->assign({edge.u, edge.v, edge.position}, formal_->class_of(sum));
    });
    annotations_.reset();
    active_.clear();
  }
}

template <Field K>
void EdgeLinkSweep<K>::solve_relations() {
  if (!formal_->has_rows() && formal_->bytes_to_solve() > most_bytes_for_formal()) return;
  const bool is_useful = formal_->solve(report_death());
  if (!is_useful || 2 * living_ <= wanted_.tuning.classes_for_formal) end_formal();
}

template <Field K>
void EdgeLinkSweep<K>::end_formal() {
  if constexpr (std::same_as<K, Z2>) {
    formal_->make_rows();
    take_births();
    annotations_ =
        std::make_unique<Annotations<K>>(field_, active_, wanted_.cocycles, &context_.memory);
    annotations_->add_generators(births_.size());
    std::pmr::vector<typename Annotations<K>::Term> terms(&context_.memory);
    formal_->for_each_edge([&](const auto& edge, const auto& sum) {
      terms.clear();
      for (const auto g : sum) terms.emplace_back(g, field_.from_int(1));
      annotations_->assign({edge.u, edge.v, edge.position}, annotations_->class_of(terms));
    });
    formal_.reset();
    living_for_formal_ = std::max(living_for_formal_, 2 * living_);
  }
}

template <Field K>
void EdgeLinkSweep<K>::take_births() {
  births_.clear();
  formal_->for_each_birth([&](Position birth) { births_.push_back(birth); });
}

template <Field K>
void EdgeLinkSweep<K>::kill(Class relation, Triangle death, Class of_edge) {
  const auto g = annotations_->youngest(relation);
  find_representative(g, relation);
  if (wanted_.cocycles) {
    const auto value = annotations_->value(of_edge, g);
    if (!field_.is_zero(value)) representative_.push_back({death.edge, value});
  }
  observer_.on_death(births_[g], death, representative_);
  if (cycles_) cycles_->erase(g);
  births_[g] = kDead;
  --living_;
  annotations_->kill(relation);
}

template <Field K>
template <class Values>
void EdgeLinkSweep<K>::find_representative(typename Annotations<K>::Generator g, Values of_cycle) {
  representative_.clear();
  if (wanted_.cocycles)
    annotations_->for_each_value(g, [&](const auto& edge, typename K::Element a) {
      representative_.push_back({edge.position, a});
    });
  if (cycles_)
    cycles_->for_each_term(of_cycle, [&](Vertex u, Vertex v, typename K::Element a) {
      representative_.push_back({observer_.position_of(u, v), a});
    });
}

extern template class EdgeLinkSweep<Z2>;
extern template class EdgeLinkSweep<Zp>;

}  // namespace ph
