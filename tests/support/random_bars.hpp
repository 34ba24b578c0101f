// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <random>
#include <vector>

#include "ph/barcode.hpp"

namespace ph::test {

using Bars = std::vector<Bar>;

/// Random bars. @param steps if 0, births and deaths are any numbers in [-1, 1]; otherwise whole
/// numbers from 0 to `steps`, with ties and bars of length 0.
inline Bars random_bars(std::mt19937& random, std::size_t count, int steps = 0) {
  const auto number = [&] {
    if (steps > 0) return static_cast<double>(std::uniform_int_distribution<>(0, steps)(random));
    return std::uniform_real_distribution<>(-1, 1)(random);
  };
  Bars bars;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = number(), b = number();
    bars.push_back({1, std::min(a, b), std::max(a, b)});
  }
  return bars;
}

}  // namespace ph::test
