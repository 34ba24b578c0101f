// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "ph/detail/binned_edges.hpp"
#include "ph/detail/parallel.hpp"
#include "ph/run_context.hpp"
#include "rips/sweep/active_edges.hpp"
#include "rips/sweep/lens_components.hpp"
#include "rips/sweep/lens_cover.hpp"
#include "rips/sweep/lens_graph.hpp"

namespace ph {

/// Looks at the lenses of edges before a sweep gets there, on another thread, with a graph of its
/// own: what a lens looks like does not depend on what lives there.
class LensScout {
 public:
  using Position = std::uint32_t;

  /// @param edges, context outlive this.
  LensScout(std::size_t vertices, const BinnedEdges& edges, const RunContext& context);

  /// What is known of an edge's lens. By the sweep, which asks in order.
  LensHint hint(Position position) {
    if (position % kReportEvery == 0) swept_.store(position, std::memory_order_relaxed);
    const std::uint64_t slot = slots_[position % kAhead].load(std::memory_order_relaxed);
    return slot >> 32 == position ? unpacked(slot) : LensHint();
  }
  /// By the sweep: edges before this one are sorted. Others are not looked at: to sort them would
  /// report progress, which comes from one thread.
  void go_until(std::size_t end) { end_.store(end, std::memory_order_release); }
  /// By the sweep: whether a class is there that may have to be extended.
  void expect_classes(bool any) {
    if (any != has_classes_.load(std::memory_order_relaxed))
      has_classes_.store(any, std::memory_order_relaxed);
  }
  /// By the scout: looks at the next edge. @return whether there is one that is not too far ahead.
  bool step();

 private:
  static constexpr Position kAhead = 1 << 12;  // a power of two
  static constexpr Position kReportEvery = 32;

  LensHint look(const FlagEdge& e);
  static std::uint64_t packed(Position position, const LensHint& hint) {
    return std::uint64_t{position} << 32 | std::uint64_t{hint.vertex} << 2 |
           static_cast<std::uint64_t>(hint.kind);
  }
  static LensHint unpacked(std::uint64_t slot) {
    return {static_cast<LensHint::Kind>(slot & 3),
            static_cast<LensHint::Vertex>((slot & UINT32_MAX) >> 2)};
  }

  const BinnedEdges& edges_;
  ActiveEdges no_edges_;
  LensGraph graph_;
  LensComponents components_;
  LensCover cover_;
  std::size_t next_ = 0;
  // Each on a line of its own: both threads look at them all the time.
  alignas(kCacheLine) std::atomic<Position> swept_{0};
  std::atomic<std::size_t> end_{0};
  alignas(kCacheLine) std::atomic<bool> has_classes_{false};
  alignas(kCacheLine) std::array<std::atomic<std::uint64_t>, kAhead> slots_{};
};

}  // namespace ph
