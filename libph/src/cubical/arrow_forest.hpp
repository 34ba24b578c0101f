// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/run_context.hpp"

namespace ph::cubical {

/// Disjoint sets of nodes, each a tree that begins as arrows: a node's parent is where its arrow
/// leads until paths are halved and roots are linked. Roots have numbers.
/// @tparam Graph `size()` nodes; `arrow(node)`: the node that it points to. Arrows make no circles
/// and end at roots.
template <class Graph>
class ArrowForest {
 public:
  ArrowForest(const Graph& graph, std::pmr::memory_resource* memory)
      : graph_(graph), next_(graph.size(), kUnknown, memory) {}

  /// Whether the node is a root, or its arrow has been looked up or replaced.
  bool is_known(std::uint32_t node) const { return next_[node] != kUnknown; }
  void set_root(std::uint32_t node, std::uint32_t number) { next_[node] = number | kIsRoot; }
  std::uint32_t number_of_root(std::uint32_t root) const { return next_[root] & ~kIsRoot; }
  /// Hangs a root, or a node that never was asked for, under another node.
  void link(std::uint32_t node, std::uint32_t to) { next_[node] = to; }

  /// The root that a node hangs under.
  std::uint32_t find(std::uint32_t node, Ticker& ticker) {
    for (std::uint32_t next = after(node); (next & kIsRoot) == 0; next = after(node)) {
      const std::uint32_t over = after(next);
      if ((over & kIsRoot) != 0) return next;
      node = next_[node] = over;
      ticker.work();
    }
    return node;
  }
  /// The same or what hangs over it.
  std::uint32_t step(std::uint32_t node) {
    const std::uint32_t next = after(node);
    return (next & kIsRoot) != 0 ? node : next;
  }
  void prefetch(std::uint32_t node) const { __builtin_prefetch(&next_[node]); }

 private:
  static constexpr std::uint32_t kIsRoot = std::uint32_t{1} << 31;
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  std::uint32_t after(std::uint32_t node) {
    const std::uint32_t next = next_[node];
    return next != kUnknown ? next : next_[node] = graph_.arrow(node);
  }

  const Graph& graph_;
  std::pmr::vector<std::uint32_t> next_;  // a node, or the number of a root
};

}  // namespace ph::cubical
