// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/rips/sweep/link_components.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"

namespace ph {

/// An order in which potentials spread over a link. In each component, they spread first from a hub
/// to all neighbours of the hub, then to the other vertices one by one. The hub and its neighbours
/// span a cone, on which every cocycle has a potential. At each further vertex, the potential must
/// agree with all neighbours that come earlier.
class LinkCover {
 public:
  using Vertex = std::uint32_t;
  using Word = bits::Word;
  struct Step {
    Vertex vertex;
    bool is_hub;
  };

  /// @param graph must outlive this object.
  LinkCover(LinkGraph& graph, std::pmr::memory_resource* memory)
      : graph_(graph),
        steps_(memory),
        sets_(memory),
        rest_(memory),
        reached_(memory),
        left_(memory) {}

  /// Covers the graph's link.
  void find(const LinkComponents& components);
  /// Covers a non-empty set of vertices of the link.
  void find(const Word* set);

  std::size_t size() const { return steps_.size(); }
  const Step& operator[](std::size_t i) const { return steps_[i]; }
  /// The neighbours of the vertex of a step. For a hub, these are all its neighbours. For any other
  /// vertex, these are the neighbours that earlier steps cover, and there is at least one such
  /// neighbour.
  const Word* neighbours(std::size_t i) const { return sets_.data() + i * graph_.words(); }

 private:
  /// Chooses a hub, which is the vertex with the most neighbours among the given vertex and a small
  /// sample of the set.
  Vertex find_hub(const Word* set, Vertex first);
  /// Covers the component of a hub. @return true if a part of the set is left in rest_.
  bool cover(const Word* set, Vertex hub);
  /// Appends a step. @return the row of the step, which receives the neighbours of the vertex in
  /// `set`.
  Word* add_step(const Step& step, const Word* set);

  LinkGraph& graph_;
  std::pmr::vector<Step> steps_;
  std::pmr::vector<Word> sets_;  // one row per step
  std::pmr::vector<Word> rest_, reached_, left_;
};

}  // namespace ph
