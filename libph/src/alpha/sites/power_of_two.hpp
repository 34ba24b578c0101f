// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

namespace ph::alpha {

/// Returns x · 2^exponent as std::ldexp does, but faster for exponents where one multiplication
/// suffices.
inline double times_power_of_two(double x, int exponent) {
  constexpr int bias = 1023, most = 1000;
  if (exponent < -most || exponent > most) return std::ldexp(x, exponent);
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(bias + exponent) << 52);
}

}  // namespace ph::alpha
