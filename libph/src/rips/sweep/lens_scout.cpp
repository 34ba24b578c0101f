// SPDX-License-Identifier: MIT
#include "rips/sweep/lens_scout.hpp"

#include <algorithm>

namespace ph {

LensScout::LensScout(std::size_t vertices, const BinnedEdges& edges, const RunContext& context)
    : edges_(edges),
      no_edges_(vertices, false, &context.memory),
      graph_(no_edges_, edges, LensLayout::rows, &context.memory),
      components_(graph_, &context.memory),
      cover_(graph_, &context.memory) {}

bool LensScout::step() {
  const std::size_t swept = swept_.load(std::memory_order_relaxed);
  if (next_ >= std::min(end_.load(std::memory_order_acquire), swept + kAhead)) return false;
  const FlagEdge& e = edges_[next_];
  if (next_ > swept) {
    const auto position = static_cast<Position>(next_);
    slots_[position % kAhead].store(packed(position, look(e)), std::memory_order_relaxed);
  }
  graph_.add(e);
  ++next_;
  return true;
}

LensHint LensScout::look(const FlagEdge& e) {
  using Kind = LensHint::Kind;
  if (graph_.find_lens(e, true).is_empty) return {};
  components_.find(e);
  if (components_.count() > 1) return {};
  const bool has_classes = has_classes_.load(std::memory_order_relaxed);
  if (components_.has_apex() || (has_classes && components_.find_apex(e)))
    return {Kind::cone, graph_.global(components_.apex())};
  const LensHint::Vertex root = components_.root(0);
  if (!has_classes) return {Kind::connected, graph_.global(root)};
  return {Kind::hub, graph_.global(cover_.find_hub(graph_.lens(), root))};
}

}  // namespace ph
