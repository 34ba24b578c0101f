// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/run_context.hpp"

namespace ph::cubical {

/// Where arrows lead: from each node that has no label of its own to one that has. What was passed
/// on the way remembers its label.
/// @tparam Graph `size()` nodes; `arrow(node)`: the node that it points to; `for_each_arrow(use)`:
/// all of them. Arrows make no circles and end at nodes with labels.
template <class Graph>
class ArrowForest {
 public:
  ArrowForest(const Graph& graph, std::pmr::memory_resource* memory)
      : graph_(graph), next_(graph.size(), kUnknown, memory) {}

  /// Looks all arrows up, one after another: quicker than when they are met, if most will be.
  void follow_all(Ticker& ticker) {
    graph_.for_each_arrow([&](std::uint32_t node, std::uint32_t to) { next_[node] = to; }, ticker);
  }

  bool has_label(std::uint32_t node) const {
    return (next_[node] & kIsLabel) && next_[node] != kUnknown;
  }
  void set_label(std::uint32_t node, std::uint32_t label) { next_[node] = label | kIsLabel; }

  std::uint32_t label(std::uint32_t node, Ticker& ticker) {
    std::uint32_t at = node, next;
    for (;; at = next) {
      next = next_[at];
      if (next == kUnknown) next = next_[at] = graph_.arrow(at);
      if ((next & kIsLabel) != 0) break;
      ticker.work();
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
