// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/sweep/link_graph.hpp"
#include "ph/detail/core/flag_filtration.hpp"

namespace ph {

/// The connected components of a link, with vertices numbered within the link. Most links are
/// cones, in which one vertex, the apex, is joined to all others. An apex is often also an apex for
/// the next edge at the same vertex.
class LinkComponents {
 public:
  using Vertex = std::uint32_t;
  using Word = bits::Word;
  static constexpr Vertex kNone = UINT32_MAX;

  /// @param graph must outlive this object.
  LinkComponents(LinkGraph& graph, std::pmr::memory_resource* memory)
      : graph_(graph),
        last_apex_(graph.vertex_count(), kNone, memory),
        roots_(memory),
        sets_(memory),
        rest_(memory) {}

  /// Finds the components of the link that is stored in the graph. Preconditions: it is the link of
  /// e, and it is not empty.
  void find(const FlagEdge& e);
  /// Finds only the roots of the components of any link. This is fast if the link has few vertices.
  void find_roots(const FlagEdge& e);
  /// Looks for an apex if `find` has not found one. @return true if there is an apex.
  bool find_apex(const FlagEdge& e);

  /// The number of components. Their roots are in ascending order.
  std::size_t count() const { return roots_.size(); }
  std::span<const Vertex> roots() const { return roots_; }
  /// The smallest vertex of a component. If the link has only one component, returns any vertex.
  Vertex root(std::size_t i) const { return roots_[i]; }
  /// The vertices of a component, unless it is the only component.
  const Word* vertices(std::size_t i) const { return sets_.data() + i * graph_.words(); }
  bool has_apex() const { return apex_ != kNone; }
  Vertex apex() const { return apex_; }

 private:
  bool is_apex(Vertex v) const {
    return bits::first_missing(graph_.link(), graph_.row(v), v, graph_.words()) == bits::kNone;
  }
  void set_apex(const FlagEdge& e, Vertex apex) {
    apex_ = apex;
    last_apex_[e.u] = last_apex_[e.v] = graph_.global(apex);
  }
  /// Moves a vertex's component from rest_ to the end of sets_. @return true if rest_ is not empty.
  bool take_component(Vertex first);
  void sort_components();

  LinkGraph& graph_;
  // For each vertex, the last apex of an edge with this vertex as an end.
  std::pmr::vector<Vertex> last_apex_;
  std::pmr::vector<Vertex> roots_;
  std::pmr::vector<Word> sets_;  // one row per component
  std::pmr::vector<Word> rest_;
  Vertex apex_ = kNone;
};

}  // namespace ph
