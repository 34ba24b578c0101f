// SPDX-License-Identifier: MIT
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "ph/error.hpp"

namespace ph::significance {

/// @throws Error (usage) unless alpha is above 0 and below 1. @param function the name of the
/// calling function, for messages.
inline void check_alpha(double alpha, std::string_view function) {
  if (!(alpha > 0 && alpha < 1))
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: alpha: found {}, expected a number above 0, below 1", function, alpha));
}

/// Sorts the numbers and returns the smallest number that is exceeded by at most a share alpha of
/// all numbers.
inline double upper_quantile(std::span<double> numbers, double alpha) {
  std::ranges::sort(numbers);
  // mutant: quantile-side
  const auto may_exceed =
      static_cast<std::size_t>(std::floor(alpha * static_cast<double>(numbers.size())));
  return numbers[numbers.size() - 1 - std::min(may_exceed, numbers.size() - 1)];
}

}  // namespace ph::significance
