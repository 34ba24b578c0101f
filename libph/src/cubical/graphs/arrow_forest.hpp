// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>

#include "ph/detail/core/parallel.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// Disjoint sets of nodes, stored as trees. At first, the parent of a node is the end of its arrow.
/// Later, parents change when paths are halved and roots are linked. Roots have numbers.
/// DisjointSets cannot be used, because parents are computed on first use, by several threads, and
/// a root stores its number instead of a parent.
/// @tparam Graph has `size()` nodes and `arrow(node)`, the node that the arrow of a node points to.
/// Arrows form no cycles, and following them ends at a root.
template <class Graph>
class ArrowForest {
 public:
  ArrowForest(const Graph& graph, const RunContext& context)
      : graph_(graph), context_(context), next_(graph.size(), &context.memory) {
    constexpr std::size_t piece = 1 << 18;
    for_each_piece("basins", next_.size(), piece, context, [&](std::size_t i, std::size_t end) {
      std::fill_n(next_.begin() + static_cast<std::ptrdiff_t>(i), end - i, kUnknown);
    });
  }

  /// True if the node is a root, or if its arrow has been looked up or replaced.
  bool is_known(std::uint32_t node) const { return next_[node] != kUnknown; }
  void set_root(std::uint32_t node, std::uint32_t number) { next_[node] = number | kIsRoot; }
  /// Links a root, or a node that is not known yet, to another node.
  void link(std::uint32_t node, std::uint32_t to) { next_[node] = to; }

  /// The root of a node's tree. Several threads may call this function at the same time if no
  /// thread changes roots or links, because each call only shortens paths.
  std::uint32_t find(std::uint32_t node) {
    std::uint32_t steps = 0;
    for (std::uint32_t next = after(node); (next & kIsRoot) == 0; next = after(node)) {
      const std::uint32_t over = after(next);
      if ((over & kIsRoot) != 0) return next;
      parent(node).store(over, std::memory_order_relaxed);
      node = over;
      if (++steps % 4096 == 0) context_.poll();
    }
    return node;
  }
  std::uint32_t number_of_root(std::uint32_t root) { return after(root) & ~kIsRoot; }

 private:
  static constexpr std::uint32_t kIsRoot = std::uint32_t{1} << 31;
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  std::atomic_ref<std::uint32_t> parent(std::uint32_t node) { return std::atomic_ref(next_[node]); }
  std::uint32_t after(std::uint32_t node) {
    const std::uint32_t next = parent(node).load(std::memory_order_relaxed);
    if (next != kUnknown) return next;
    const std::uint32_t arrow = graph_.arrow(node);
    parent(node).store(arrow, std::memory_order_relaxed);
    return arrow;
  }

  const Graph& graph_;
  const RunContext& context_;
  RawVector<std::uint32_t> next_;  // a node, or the number of a root
};

}  // namespace ph::cubical
