// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "ph/detail/rips/rips_adjacency.hpp"

namespace ph {

/// Up to 64 consecutive vertices, each with the key of the cofacet that it forms with a simplex:
/// the maximum of the simplex's key and the keys of the edges to its vertices. All keys are
/// computed at once, in vector registers.
class KeyBlock {
 public:
  using Key = RipsAdjacency::Key;
  static constexpr std::uint32_t kSize = 64;

  /// @param rows the rows of the simplex's vertices in the matrix of keys. @param begin the first
  /// vertex.
  /// @param size the number of vertices. @param key the key of the simplex. @param first, last the
  /// range of keys for `within`.
  KeyBlock(std::span<const Key* const> rows, std::uint32_t begin, std::uint32_t size, Key key,
           Key first, Key last);

  Key operator[](std::uint32_t i) const { return keys_[i]; }
  /// A bit for each vertex whose key is in the range.
  std::uint64_t within() const { return within_; }

 private:
  std::array<Key, kSize> keys_;
  std::uint64_t within_;
};

}  // namespace ph
