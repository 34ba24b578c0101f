// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>

#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// Disjoint sets of basins, joined by the elder rule. Basins that were always there are older than
/// all others. The other basins are compared by value, then by number. DisjointSets is not used,
/// because parents and values are read at random places in memory, and here a parent and its value
/// share a cache line.
/// @tparam backwards true if basins with higher values and numbers are older.
template <bool backwards>
class ElderForest {
 public:
  /// @param value_of called with i: returns the value of the i-th root that was not always there.
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
  /// Links the younger of two roots to the older. @return the younger root.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    if (is_elder(b, a)) std::swap(a, b);
    nodes_[b].parent = a;
    return b;
  }
  void prefetch(std::uint32_t basin) const { __builtin_prefetch(&nodes_[basin]); }

 private:
  struct Node {
    double value;
    std::uint32_t parent;  // a root is its own parent
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
