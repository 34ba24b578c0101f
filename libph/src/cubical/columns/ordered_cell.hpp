// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "ph/detail/core/radix_sort.hpp"

namespace ph::cubical {

/// A cell that can be compared with other cells of its dimension in the order of the stars
/// (GridFrame): by the value of its star, then by name. The cells may be in different parts of a
/// grid.
/// @tparam rank_bits the number of bits that hold the rank of a direction in a star.
template <unsigned rank_bits>
struct OrderedCell {
  std::uint64_t key;  ///< has the same order as the value
  /// The high bits are the number of the voxel in the entire grid. The low bits are the rank of the
  /// direction.
  std::uint64_t name;

  static OrderedCell of(double value, std::uint64_t voxel, int rank) {
    return {ordered_bits(value + 0.0), voxel << rank_bits | static_cast<std::uint64_t>(rank)};
  }
  std::uint64_t voxel() const { return name >> rank_bits; }
  int rank() const { return static_cast<int>(name & ((1U << rank_bits) - 1)); }
  double value() const { return from_ordered_bits(key); }
  friend bool operator==(const OrderedCell& a, const OrderedCell& b) { return a.name == b.name; }
  static bool precedes(const OrderedCell& a, const OrderedCell& b) {
    __extension__ using Wide = unsigned __int128;
    return (Wide{a.key} << 64 | a.name) < (Wide{b.key} << 64 | b.name);
  }
  static bool follows(const OrderedCell& a, const OrderedCell& b) { return precedes(b, a); }
};

using LoopEdge = OrderedCell<3>;
using LoopSquare = OrderedCell<4>;

}  // namespace ph::cubical
