// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/rips/link_loops.hpp"
#include "libph/src/rips/surfaces/link_surfaces.hpp"
#include "libph/src/rips/sweep/link_components.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "libph/src/rips/sweep/sweep_observer.hpp"
#include "libph/src/rips/volumes/link_volumes.hpp"
#include "ph/detail/components/elder_rule.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/rips/binned_edges.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Computes H0 to H3 of a Vietoris-Rips filtration edge by edge, without listing triangles.
///
/// Consider an edge e = (u,v). Its link consists of the vertices that are already joined to both u
/// and v, and the triangles that enter with e are the triangles over this link. All triangles over
/// one connected component of the link are equivalent, so one triangle per component determines H1
/// (Koyama, Mémoli, Robins, Turner, Faster computation of degree-1 persistent homology using the
/// reduced Vietoris-Rips filtration). If the link is empty, e joins two components or gives birth
/// to a class. Otherwise, the first triangle determines the annotation of e. For a vertex w of each
/// further component, the sum a(u,w) + a(w,v) should equal that annotation. If it does not, the
/// youngest generator of the difference dies. If a further component kills nothing, a class of H2
/// is born. An edge is *active* if it has an annotation that is not zero. For almost all edges, no
/// edge between u or v and the link is active, and no class of H1 dies. See LinkLoops,
/// LinkSurfaces, LinkVolumes and docs/explanation/engines/edge-links.md.
template <Field K>
class EdgeLinkSweep {
 public:
  using Observer = SweepObserver<K>;
  using Vertex = typename Observer::Vertex;
  using Position = typename Observer::Position;

  /// @param births the births of the vertices; if empty, all vertices enter before all edges.
  /// @param edges must outlive the sweep. If no edge of the last bins can change anything, these
  /// bins are never sorted.
  EdgeLinkSweep(std::size_t vertices, std::span<const double> births, const BinnedEdges& edges,
                const K& field, SweepRequest wanted, Observer& observer, const RunContext& context)
      : edges_(edges),
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
        loops_(graph_, active_, components_, field, wanted, observer, context) {
    if (wanted.surfaces) surfaces_.emplace(graph_, field, wanted, observer, context);
    if (wanted.volumes) volumes_.emplace(graph_, field, observer, context);
  }

  void run();

 private:
  /// True if only edges with an empty link matter at this time.
  bool can_skip_bins() const {
    // mutant: bins-skipped
    return !surfaces_ && !wanted_.zero_length && loops_.living_count() == 0;
  }
  /// True if nothing happens at the edges of a bin. These edges are not added at once (see
  /// first_unadded_bin_).
  bool can_skip_bin(std::size_t bin);
  /// Adds the edges of skipped bins.
  void add_bins_until(std::size_t bin);
  void add_edge(Position position);
  void join_or_give_birth(Position position, const FlagEdge& e);

  const BinnedEdges& edges_;
  SweepRequest wanted_;
  Observer& observer_;
  const RunContext& context_;
  const LinkLayout layout_;
  ActiveEdges active_;  // edges with a non-zero annotation
  // The edges so far, except skipped edges that have not been added yet.
  LinkGraph graph_;
  LinkComponents components_;           // components of the graph's link
  std::pmr::vector<std::size_t> born_;  // components with which a class of H2 is born
  std::size_t first_unadded_bin_ = 0;
  std::pmr::vector<std::uint32_t> age_;  // age of each vertex
  DisjointSets sets_;                    // each root is the oldest vertex of its component
  LinkLoops<K> loops_;
  std::optional<LinkSurfaces<K>> surfaces_;
  std::optional<LinkVolumes<K>> volumes_;
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
  loops_.finish();
  if (surfaces_) surfaces_->finish();
  if (volumes_) volumes_->finish();
}

template <Field K>
bool EdgeLinkSweep<K>::can_skip_bin(std::size_t bin) {
  // A link that is not empty never becomes empty, and an edge with such a link joins no components.
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
  // mutant: bins-added
  edges_.with_bins(first_unadded_bin_, bin,
                   [&](std::span<const FlagEdge> edges) { graph_.add_all(edges, context_); });
  first_unadded_bin_ = bin;
}

template <Field K>
void EdgeLinkSweep<K>::add_edge(Position position) {
  const FlagEdge& e = edges_[position];
  const LinkGraph::Link link =
      graph_.find_link(e, surfaces_ || wanted_.zero_length || loops_.wants_all_links());
  if (link.is_empty) {
    join_or_give_birth(position, e);
  } else {
    if (wanted_.zero_length) loops_.report_zero_length(position, e);
    born_.clear();
    if (link.touches_active || loops_.wants_all_links()) {
      loops_.annotate(position, e, born_);
    } else if (surfaces_) {
      components_.find(e);
      for (std::size_t i = 1; i < components_.count(); ++i) born_.push_back(i);
    }
    if (volumes_) volumes_->look(e, components_);
    if (surfaces_) {
      surfaces_->extend(position, e, components_,
                        volumes_ ? volumes_->loops() : std::span<LinkPairs<K>* const>());
      for (const std::size_t i : born_)
        surfaces_->give_birth({position, graph_.global(components_.root(i))}, e,
                              components_.vertices(i));
    }
    if (volumes_) {
      for (const auto& [birth, loop] : surfaces_->births_above())
        volumes_->give_birth(birth, e, *loop);
      volumes_->extend(position, e);
    }
  }
  graph_.add(e);
}

template <Field K>
void EdgeLinkSweep<K>::join_or_give_birth(Position position, const FlagEdge& e) {
  Vertex elder = sets_.find(e.u), younger = sets_.find(e.v);
  if (elder != younger) {
    if (age_[younger] < age_[elder]) std::swap(elder, younger);  // mutant: weights-elder
    sets_.link(younger, elder);
    observer_.on_join(elder, younger, position);
    return;
  }
  loops_.give_birth(position, e);
}

extern template class EdgeLinkSweep<Z2>;
extern template class EdgeLinkSweep<Zp>;

}  // namespace ph
