// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/engine/lens_graph.hpp"

namespace ph {

/// A lens reduced by strong collapses (Barmak, Minian, Strong homotopy types, nerves and
/// collapses): a vertex whose neighbours are all neighbours of another one, its hub, is taken out
/// of the graph, and the flag complex keeps its homotopy type. A few hubs take out most of a lens.
class LensCore {
 public:
  using Vertex = std::uint32_t;
  using Word = bits::Word;

  /// @param graph outlives this.
  LensCore(LensGraph& graph, std::pmr::memory_resource* memory)
      : graph_(graph), rest_(memory), hubs_(memory), taken_(memory) {}

  /// @param size how many vertices the lens has. @param first one of them: the hub to begin with.
  void find(std::size_t size, Vertex first);
  /// Nothing is taken out.
  void keep_all();

  /// What no hub took.
  const Word* rest() const { return rest_.data(); }
  /// In the order in which they took; a hub may be taken by a later one.
  std::size_t hub_count() const { return hubs_.size(); }
  Vertex hub(std::size_t i) const { return hubs_[i]; }
  /// What a hub took: neighbours of it.
  const Word* taken(std::size_t i) const { return taken_.data() + i * graph_.words(); }

 private:
  /// @return how many vertices it takes out.
  std::size_t take_dominated(Vertex hub);
  /// Among a few vertices of the rest the one with most neighbours there.
  Vertex sampled_hub(std::size_t left, std::size_t round) const;

  LensGraph& graph_;
  std::pmr::vector<Word> rest_;
  std::pmr::vector<Vertex> hubs_;
  std::pmr::vector<Word> taken_;  // a row for each hub
};

}  // namespace ph
