// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace ph::alpha {

/// The place of a cell along the Hilbert curve of a grid of 2^bits cells a side, by the transform
/// of Skilling, Programming the Hilbert curve, 2004. Precondition: N · bits <= 64.
template <std::size_t N>
std::uint64_t hilbert_place(std::array<std::uint32_t, N> x, int bits) {
  // From coordinates to the transposed place: rotations and reflections undone, top down.
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
  // Gray code.
  for (std::size_t i = 1; i < N; ++i) x[i] ^= x[i - 1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = 1U << (bits - 1); bit > 1; bit >>= 1)
    if ((x[N - 1] & bit) != 0) flip ^= bit - 1;
  for (std::uint32_t& v : x) v ^= flip;
  // The bits of the coordinates, one after another.
  std::uint64_t place = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (std::size_t i = 0; i < N; ++i) place = place << 1 | (x[i] >> b & 1U);
  return place;
}

}  // namespace ph::alpha
