// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace ph::cubical {

/// Where arrows lead: from each node that has no label of its own to one that has. Looked up when
/// asked for; what was passed on the way remembers its label.
/// @tparam Graph `arrow(node)`: the node that it points to. Arrows make no circles and end at nodes
/// with labels.
template <class Graph>
class ArrowForest {
 public:
  /// Nodes and labels are below it.
  static constexpr std::uint32_t kMost = (std::uint32_t{1} << 31) - 1;

  ArrowForest(const Graph& graph, std::size_t nodes, std::pmr::memory_resource* memory)
      : graph_(graph), next_(nodes, kUnknown, memory) {}

  bool has_label(std::uint32_t node) const {
    return (next_[node] & kIsLabel) && next_[node] != kUnknown;
  }
  void set_label(std::uint32_t node, std::uint32_t label) { next_[node] = label | kIsLabel; }

  std::uint32_t label(std::uint32_t node) {
    std::uint32_t at = node, next;
    for (;; at = next) {
      next = next_[at];
      if (next == kUnknown) next = next_[at] = graph_.arrow(at);
      if ((next & kIsLabel) != 0) break;
    }
    while (node != at) {
      const std::uint32_t behind = next_[node];
      next_[node] = next;
      node = behind;
    }
    return next & ~kIsLabel;
  }

 private:
  static constexpr std::uint32_t kIsLabel = std::uint32_t{1} << 31;
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  const Graph& graph_;
  std::pmr::vector<std::uint32_t> next_;  // a node, or a label
};

}  // namespace ph::cubical
