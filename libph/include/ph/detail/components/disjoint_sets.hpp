// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

namespace ph {

/// Disjoint sets of 0 … size-1, with path halving and without ranks. The caller decides which root
/// survives.
class DisjointSets {
 public:
  DisjointSets(std::size_t size, std::pmr::memory_resource* memory) : parent_(size, memory) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// Adds a set. @return its only member.
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
  /// Prefetches the entry that `find` reads first. Call it some time before `find`, because a
  /// memory access takes longer than the other work on a set.
  void prefetch(std::uint32_t v) const { __builtin_prefetch(&parent_[v]); }
  /// Prefetches the entry that `find` reads next. Call it when `prefetch` has had time to finish.
  void prefetch_parent(std::uint32_t v) const { __builtin_prefetch(&parent_[parent_[v]]); }
  /// Makes `root` the parent of `child`. Precondition: `child` is the root of a set that does not
  /// contain `root`.
  void link(std::uint32_t child, std::uint32_t root) { parent_[child] = root; }

 private:
  std::pmr::vector<std::uint32_t> parent_;
};

}  // namespace ph
