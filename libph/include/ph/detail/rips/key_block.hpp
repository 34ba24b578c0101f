// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "ph/detail/rips/rips_adjacency.hpp"

namespace ph {

/// Up to 64 vertices in a row, each with the key of the cofacet that it makes of a simplex: the
/// largest of the simplex's own and of those that join it to the simplex. All at once, in vector
/// registers.
class KeyBlock {
 public:
  using Key = RipsAdjacency::Key;
  static constexpr std::uint32_t kSize = 64;

  /// @param rows of the simplex's vertices in the matrix of keys. @param begin the first vertex.
  /// @param size how many. @param key of the simplex. @param first, last the range that is asked
  /// for.
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
