// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

namespace ph {

/// Disjoint sets of 0 … size-1 by rank-free linking with path halving. The caller decides which
/// root survives.
class DisjointSets {
 public:
  DisjointSets(std::size_t size, std::pmr::memory_resource* memory) : parent_(size, memory) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// One more set. @return its only member.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  /// Some time before `find`: memory is slower than what else is done for a set.
  void prefetch(std::uint32_t v) const { __builtin_prefetch(&parent_[v]); }
  /// The same once `prefetch` has had its time: what `find` looks at next.
  void prefetch_parent(std::uint32_t v) const { __builtin_prefetch(&parent_[parent_[v]]); }
  /// Precondition: `child` is a root, and not that of `root`, which will be its parent.
  void link(std::uint32_t child, std::uint32_t root) { parent_[child] = root; }

 private:
  std::pmr::vector<std::uint32_t> parent_;
};

}  // namespace ph
