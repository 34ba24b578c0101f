// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// For each pair of parts, the first edge between them, in the order of the filtration. Several
/// threads may offer edges at once.
class FirstEdges {
 public:
  /// @param limit longer edges are not taken.
  FirstEdges(std::size_t parts, double limit, const RunContext& context);
  /// No edge with a larger value is needed.
  double value(std::uint32_t a, std::uint32_t b) const {
    return values_[place(a, b)].load(std::memory_order_relaxed);
  }
  void offer(std::uint32_t a, std::uint32_t b, const FlagEdge& edge);
  std::optional<FlagEdge> edge(std::uint32_t a, std::uint32_t b) const {
    const FlagEdge& first = edges_[place(a, b)];
    return first.u == kNoEnd ? std::nullopt : std::optional(first);
  }

 private:
  static constexpr std::uint32_t kNoEnd = UINT32_MAX;
  std::size_t place(std::uint32_t a, std::uint32_t b) const {
    return std::max(a, b) * parts_ + std::min(a, b);
  }
  std::size_t parts_;
  std::pmr::vector<FlagEdge> edges_;
  std::pmr::vector<std::atomic<double>> values_;
  std::mutex mutex_;
};

}  // namespace ph
