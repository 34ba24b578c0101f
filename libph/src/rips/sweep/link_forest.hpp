// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "libph/src/rips/sweep/link_graph.hpp"

namespace ph {

/// The components of a growing graph. Vertices come one by one, in ascending order, each with its
/// edges to earlier vertices. If the graph is the link of an edge of the filtration, the edges of
/// the graph correspond to the tetrahedra over that edge, in the same order.
class LinkForest {
 public:
  using Vertex = std::uint32_t;
  using Word = bits::Word;

  /// A part that contains neighbours of the next vertex, and the first of these neighbours.
  struct Meeting {
    std::size_t part;
    Vertex at;
  };

  /// @param graph must outlive this object.
  LinkForest(LinkGraph& graph, std::pmr::memory_resource* memory)
      : graph_(graph),
        roots_(memory),
        parts_(memory),
        meetings_(memory),
        shared_(memory),
        before_(memory) {}

  void clear() {
    roots_.clear();
    parts_.clear();
  }
  /// Finds the parts that the next vertex of a set is joined to.
  void meet(Vertex y, const Word* set);
  /// The parts found, in the order of the edges from y. They are valid until the next `meet`.
  const std::pmr::vector<Meeting>& meetings() const { return meetings_; }
  /// The neighbours of y in a part. The words up to the word of y are valid.
  const Word* neighbours(std::size_t meeting) const {
    return shared_.data() + meeting * graph_.words();
  }
  /// The neighbours of y before y. The words up to the word of y are valid.
  const Word* neighbours() const { return before_.data(); }
  const Word* part(const Meeting& m) const { return part(m.part); }
  /// The number of all parts. Parts that were merged into others are empty.
  std::size_t part_count() const { return roots_.size(); }
  const Word* part(std::size_t i) const { return parts_.data() + i * graph_.words(); }

  /// Adds the vertex y, which is a part of its own at first. Calls `on_join(younger root, its
  /// vertices, w)` for each edge wy that joins two parts.
  template <class OnJoin>
  void join(Vertex y, OnJoin&& on_join);

  /// The number of words for the vertices up to y.
  static std::size_t words_to(Vertex y) { return y / 64 + 1; }

 private:
  Word* set_of(std::size_t part) { return parts_.data() + part * graph_.words(); }
  void start_part(Vertex y);
  /// Moves one part into another.
  void unite(std::size_t from, std::size_t to);

  LinkGraph& graph_;
  std::pmr::vector<Vertex> roots_;  // smallest vertex of each part
  // One row for each part; empty once the part has been merged into another.
  std::pmr::vector<Word> parts_;
  std::pmr::vector<Meeting> meetings_;
  std::pmr::vector<Word> shared_;  // one row per meeting
  std::pmr::vector<Word> before_;
};

template <class OnJoin>
void LinkForest::join(Vertex y, OnJoin&& on_join) {
  start_part(y);
  std::size_t all = roots_.size() - 1;
  for (const auto& [part, at] : meetings_) {
    const bool is_elder = roots_[part] < roots_[all];  // mutant: surface-elder-part
    const std::size_t younger = is_elder ? all : part, elder = is_elder ? part : all;
    on_join(roots_[younger], set_of(younger), at);
    unite(younger, elder);
    all = elder;
  }
}

}  // namespace ph
