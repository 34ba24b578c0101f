// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "libph/src/rips/beta_skeleton/lenses.hpp"
#include "libph/src/rips/beta_skeleton/relative_neighbours.hpp"

namespace ph::beta_skeleton {

/// The generators of H1, and the formal annotation of any edge. There is one generator for each
/// edge of the relative neighbourhood graph that does not join components. A formal annotation is a
/// signed sum of generators.
template <int D>
class SkeletonCycles {
 public:
  static constexpr std::uint32_t kNoGenerator = UINT32_MAX;

  /// @param edges the edges of the relative neighbourhood graph. @param generators the generator of
  /// each edge, or kNoGenerator.
  SkeletonCycles(const Lenses<D>& lenses, std::span<const FoundEdge> edges,
                 std::span<const std::uint32_t> generators, std::pmr::memory_resource* memory)
      : lenses_(lenses),
        begin_(lenses.tree().size() + 1, 0, memory),
        ends_(2 * edges.size(), memory),
        stack_(memory) {
    for (const FoundEdge& e : edges) {
      ++begin_[e.u + 1];
      ++begin_[e.v + 1];
    }
    for (std::size_t p = 1; p < begin_.size(); ++p) begin_[p] += begin_[p - 1];
    for (std::size_t i = edges.size(); i-- > 0;) {
      const auto& [value, u, v] = edges[i];
      ends_[--begin_[u + 1]] = {v, generators[i]};
      ends_[--begin_[v + 1]] = {u, generators[i]};
    }
    // The entry for p + 1 is now the start of the list of p. All entries are therefore shifted by
    // one.
    std::copy(begin_.begin() + 1, begin_.end(), begin_.begin());
    begin_.back() = static_cast<std::uint32_t>(ends_.size());
  }

  /// Calls `visit(generator, is_positive)` for the terms of a formal annotation of x -> y. If the
  /// lens of the edge is empty, there is at most one term. Otherwise, the annotation is the sum of
  /// the annotations of x -> w and w -> y, where w is any point of the lens. These two edges come
  /// before x -> y.
  template <class Visit>
  void annotate(Position x, Position y, Visit&& visit) {
    stack_.assign(1, {x, y});
    while (!stack_.empty()) {
      const auto [from, to] = stack_.back();
      stack_.pop_back();
      if (const End* const end = find(from, to)) {
        // Generators are directed from the smaller vertex to the larger vertex.
        if (end->generator != kNoGenerator)
          // mutant: beta-sign
          visit(end->generator, lenses_.tree().row(from) < lenses_.tree().row(to));
        continue;
      }
      const Edge e = lenses_.edge(from, to);
      const Position w = lenses_.middle(e, lenses_.holder_of(e));
      if (w == kNone) throw std::logic_error("an edge with an empty lens is not in the graph");
      stack_.push_back({from, w});
      stack_.push_back({w, to});
    }
  }

 private:
  struct End {
    Position other;
    std::uint32_t generator;
  };
  const End* find(Position x, Position y) const {
    for (std::uint32_t i = begin_[x]; i < begin_[x + 1]; ++i)
      if (ends_[i].other == y) return &ends_[i];
    return nullptr;
  }

  const Lenses<D>& lenses_;
  // For each position, its first entry in the list of ends.
  std::pmr::vector<std::uint32_t> begin_;
  std::pmr::vector<End> ends_;
  std::pmr::vector<std::pair<Position, Position>> stack_;  // scratch
};

}  // namespace ph::beta_skeleton
