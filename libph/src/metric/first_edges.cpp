// SPDX-License-Identifier: MIT
#include "libph/src/metric/first_edges.hpp"

namespace ph {

FirstEdges::FirstEdges(std::size_t parts, double limit, const RunContext& context)
    : parts_(parts),
      edges_(parts * parts, FlagEdge{limit, kNoEnd, kNoEnd}, &context.memory),
      values_(parts * parts, &context.memory) {
  for (auto& value : values_) value.store(limit, std::memory_order_relaxed);
}

void FirstEdges::offer(std::uint32_t a, std::uint32_t b, const FlagEdge& edge) {
  const std::lock_guard lock(mutex_);
  FlagEdge& first = edges_[place(a, b)];
  if (!precedes(edge, first)) return;  // mutant: first-edges
  first = edge;
  values_[place(a, b)].store(edge.value, std::memory_order_relaxed);
}

}  // namespace ph
