// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>

#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// Disjoint sets of basins that know which one is older. What has always been there is older than
/// all else; of others the value decides, then the number. No DisjointSets: parents and values lie
/// anywhere in memory, and side by side they come in one cache line.
/// @tparam backwards whether high values and numbers are old.
template <bool backwards>
class ElderForest {
 public:
  /// @param value_of(i) of the root i of the basins.
  template <class ValueOf>
  ElderForest(std::uint32_t outer_count, std::size_t roots, ValueOf&& value_of,
              const RunContext& context)
      : outer_count_(outer_count), nodes_(outer_count + roots, &context.memory) {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      nodes_[i] = {i < outer_count ? 0 : value_of(i - outer_count), i};
  }
  std::uint32_t parent(std::uint32_t basin) const { return nodes_[basin].parent; }
  std::uint32_t find(std::uint32_t basin) {
    while (parent(basin) != basin) basin = nodes_[basin].parent = parent(parent(basin));
    return basin;
  }
  bool is_root(std::uint32_t basin) const { return parent(basin) == basin; }
  double value(std::uint32_t basin) const { return nodes_[basin].value; }
  /// Hangs the younger one of two roots under the other. @return the younger one.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    if (is_elder(b, a)) std::swap(a, b);
    nodes_[b].parent = a;
    return b;
  }
  void prefetch(std::uint32_t basin) const { __builtin_prefetch(&nodes_[basin]); }

 private:
  struct Node {
    double value;
    std::uint32_t parent;  // a root's is itself
  };
  bool is_elder(std::uint32_t a, std::uint32_t b) const {
    if (a < outer_count_ || b < outer_count_) return a < b;
    const double x = value(a), y = value(b);
    if (x != y) return backwards ? x > y : x < y;
    return backwards ? a > b : a < b;
  }

  std::uint32_t outer_count_;
  RawVector<Node> nodes_;
};

}  // namespace ph::cubical
