// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "libph/src/rips/annotations/annotations.hpp"
#include "libph/src/rips/link_cycles.hpp"
#include "libph/src/rips/relations/relation_solver.hpp"
#include "libph/src/rips/sweep/active_edges.hpp"
#include "libph/src/rips/sweep/link_components.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "libph/src/rips/sweep/sweep_observer.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Computes H1 of a Vietoris-Rips filtration edge by edge. The class computes the annotations of
/// edges, and the births, deaths and representatives of classes. Over Z/2, while hundreds of
/// classes are alive and only their pairs are wanted, a RelationSolver may do this work instead.
template <Field K>
class LinkLoops {
 public:
  using Observer = SweepObserver<K>;
  using Vertex = typename Observer::Vertex;
  using Position = typename Observer::Position;

  /// All references must outlive this object. @param graph the edges so far. @param active the
  /// edges with a non-zero annotation. @param components the components of the graph's link.
  LinkLoops(LinkGraph& graph, ActiveEdges& active, LinkComponents& components, const K& field,
            SweepRequest wanted, Observer& observer, const RunContext& context)
      : graph_(graph),
        active_(active),
        components_(components),
        field_(field),
        wanted_(wanted),
        observer_(observer),
        context_(context),
        living_for_solver_(wanted.tuning.classes_for_formal),
        representative_(&context.memory) {
    begin_annotations();
    if (wanted.cycles) cycles_.emplace(graph, *annotations_, field, &context.memory);
  }

  std::size_t living_count() const {
    return solver_ ? solver_->living_count() : annotations_->living_count();
  }
  /// True if edges must be annotated even if no active edge touches their links.
  bool wants_all_links() const { return solver_.has_value(); }

  /// Adds a class that is born with an edge, which must close a loop and have an empty link.
  void give_birth(Position position, const FlagEdge& e);
  /// Reports the pair of an edge and the first triangle over it.
  void report_zero_length(Position position, const FlagEdge& e);
  /// Annotates the edge whose link is stored in the graph, and kills the classes that die with
  /// further components of the link. The link must not be empty. @param idle receives the
  /// components that kill nothing, unless all links are wanted.
  void annotate(Position position, const FlagEdge& e, std::pmr::vector<std::size_t>& idle);
  /// Reports the classes that never die.
  void finish();

 private:
  using Class = typename Annotations<K>::Class;
  using Triangle = typename Observer::Triangle;

  void begin_annotations() {
    annotations_.emplace(field_, active_, wanted_.cocycles, &context_.memory);
  }
  /// True if many classes are alive, only their pairs are wanted, and active edges and memory allow
  /// a solver.
  bool wants_solver() const {
    return living_count() >= living_for_solver_ && active_.has_rows() && !wanted_.surfaces &&
           !wanted_.cycles && !wanted_.cocycles &&
           RelationSolver::fits(graph_.vertex_count(), context_.memory);
  }
  void annotate_by_solver(Position position, const FlagEdge& e);
  /// Kills a class. @param of_edge the annotation that the last edge is about to get.
  void kill(Class relation, Triangle death, Class of_edge);
  /// Sets representative_ if representatives are wanted. If cocycles are wanted, it becomes the
  /// values of generator g on the edges before the current one. If cycles are wanted, it becomes
  /// the cycle of a generator or the cycle of a class.
  /// @param of_cycle this generator, or the values of the class.
  template <class Values>
  void find_representative(typename Annotations<K>::Generator g, Values of_cycle);

  LinkGraph& graph_;
  ActiveEdges& active_;
  LinkComponents& components_;
  const K& field_;
  SweepRequest wanted_;
  Observer& observer_;
  const RunContext& context_;
  std::optional<Annotations<K>> annotations_;
  std::optional<RelationSolver> solver_;  // replaces annotations while many classes are alive
  std::size_t living_for_solver_;
  std::optional<LinkCycles<K>> cycles_;
  std::pmr::vector<typename Observer::EdgeValue> representative_;
};

template <Field K>
void LinkLoops<K>::give_birth(Position position, const FlagEdge& e) {
  if (solver_) return solver_->give_birth({e.u, e.v, position});
  if (cycles_) cycles_->add(e.u, e.v);
  annotations_->add_generator({e.u, e.v, position});
  if constexpr (std::same_as<K, Z2>) {
    if (!wants_solver()) return;
    solver_.emplace(graph_.vertex_count(), *annotations_, observer_, wanted_.tuning,
                    context_.memory);
    annotations_.reset();
    active_.clear();
  }
}

template <Field K>
void LinkLoops<K>::report_zero_length(Position position, const FlagEdge& e) {
  const Vertex apex = graph_.global(graph_.first());
  representative_.clear();
  if (wanted_.cocycles || wanted_.cycles) representative_.push_back({position, field_.from_int(1)});
  // The path leads from u to v, to the apex and back to u, where u > v.
  if (wanted_.cycles)
    for (const auto& [from, to] : {std::pair{e.v, apex}, std::pair{apex, e.u}})
      representative_.push_back(
          {observer_.position_of(from, to), field_.from_int(from > to ? 1 : -1)});
  observer_.on_death(position, {position, apex}, representative_);
}

template <Field K>
void LinkLoops<K>::annotate(Position position, const FlagEdge& e,
                            std::pmr::vector<std::size_t>& idle) {
  if (solver_) return annotate_by_solver(position, e);
  components_.find(e);
  const auto around = [&](Vertex w) {
    return annotations_->sum(annotations_->of(e.u, w), annotations_->of(w, e.v));
  };
  const Vertex first = graph_.global(components_.root(0));
  Class value = around(first);
  for (std::size_t i = 1; i < components_.count(); ++i) {  // mutant: link-components
    const Vertex root = graph_.global(components_.root(i));
    const Class difference = annotations_->sum(around(root), -value);
    if (difference.is_zero()) {
      idle.push_back(i);  // mutant: idle-components
      continue;
    }
    kill(difference, {position, root}, value);
    value = around(first);
  }
  if (!value.is_zero()) annotations_->assign({e.u, e.v, position}, value);
}

template <Field K>
void LinkLoops<K>::annotate_by_solver(Position position, const FlagEdge& e) {
  if constexpr (std::same_as<K, Z2>) {
    solver_->prefetch(e.u, e.v, {graph_.link(), graph_.words()});
    components_.find_roots(e);
    if (solver_->annotate({e.u, e.v, position}, components_.roots())) return;
    begin_annotations();
    solver_->hand_over(*annotations_);
    solver_.reset();
    living_for_solver_ = std::max(living_for_solver_, 2 * living_count());
  }
}

template <Field K>
void LinkLoops<K>::finish() {
  if (solver_) return solver_->finish();
  annotations_->for_each_living([&](typename Annotations<K>::Generator g, Position birth) {
    find_representative(g, g);
    observer_.on_essential(birth, representative_);
  });
}

template <Field K>
void LinkLoops<K>::kill(Class relation, Triangle death, Class of_edge) {
  const auto g = annotations_->youngest(relation);
  find_representative(g, relation);
  if (wanted_.cocycles) {
    const auto value = annotations_->value(of_edge, g);
    if (!field_.is_zero(value)) representative_.push_back({death.edge, value});
  }
  observer_.on_death(annotations_->birth(g), death, representative_);
  if (cycles_) cycles_->erase(g);
  annotations_->kill(relation);
}

template <Field K>
template <class Values>
void LinkLoops<K>::find_representative(typename Annotations<K>::Generator g, Values of_cycle) {
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

}  // namespace ph
