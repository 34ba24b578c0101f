// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace ph::alpha {

/// Spreads the bits of a number by putting N - 1 zeros before each bit.
template <std::size_t N>
std::uint64_t spread(std::uint64_t x) {
  static_assert(N == 2 || N == 3);
  if constexpr (N == 2) {
    x = (x | x << 16) & 0x0000FFFF0000FFFF;
    x = (x | x << 8) & 0x00FF00FF00FF00FF;
    x = (x | x << 4) & 0x0F0F0F0F0F0F0F0F;
    x = (x | x << 2) & 0x3333333333333333;
    return (x | x << 1) & 0x5555555555555555;
  } else {
    x = (x | x << 32) & 0x001F00000000FFFF;
    x = (x | x << 16) & 0x001F0000FF0000FF;
    x = (x | x << 8) & 0x100F00F00F00F00F;
    x = (x | x << 4) & 0x10C30C30C30C30C3;
    return (x | x << 2) & 0x1249249249249249;
  }
}

/// The position of a cell along the Hilbert curve of a grid with 2^bits cells per side, by
/// Skilling's transform (Programming the Hilbert curve, 2004). Precondition: N · bits <= 64.
template <std::size_t N>
std::uint64_t hilbert_place(std::array<std::uint32_t, N> x, int bits) {
  // Converts coordinates to the transposed position: undoes rotations and reflections from the top
  // down.
  for (std::uint32_t bit = 1U << (bits - 1); bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::size_t i = 0; i < N; ++i) {
      if ((x[i] & bit) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t swapped = (x[0] ^ x[i]) & below;
        x[0] ^= swapped;
        x[i] ^= swapped;
      }
    }
  }
  // Decodes the Gray code.
  for (std::size_t i = 1; i < N; ++i) x[i] ^= x[i - 1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = 1U << (bits - 1); bit > 1; bit >>= 1)
    if ((x[N - 1] & bit) != 0) flip ^= bit - 1;
  for (std::uint32_t& v : x) v ^= flip;
  std::uint64_t place = 0;
  for (std::size_t i = 0; i < N; ++i) place = place << 1 | spread<N>(x[i]);
  return place;
}

}  // namespace ph::alpha
