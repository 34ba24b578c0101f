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
  std::size_t size() const { return parent_.size(); }
  /// Adds sets of one.
  void grow(std::size_t count) {
    const std::size_t before = size();
    parent_.resize(before + count);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(before), parent_.end(),
              static_cast<std::uint32_t>(before));
  }
  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  /// Precondition: `child` is a root, and not that of `to`, which will be its parent.
  void link(std::uint32_t child, std::uint32_t to) { parent_[child] = to; }
  /// The root of both sets together: the smaller one of the two.
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) link(a > b ? a : b, a > b ? b : a);
  }

 private:
  std::pmr::vector<std::uint32_t> parent_;
};

}  // namespace ph
