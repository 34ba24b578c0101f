// SPDX-License-Identifier: MIT
#include "ph/detail/core/format_size.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

namespace ph {

std::string format_size(double bytes) {
  constexpr std::string_view kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  std::size_t unit = 0;
  while (bytes >= 1024 && unit + 1 < std::size(kUnits)) {
    bytes /= 1024;
    ++unit;
  }
  // Sizes have at most three digits. From 999.5 up to the next unit they have at most four, because
  // units are powers of 1024, and three digits would be rounded to 1e+03.
  constexpr double kFourDigits = 999.5;
  return fmt::format("{:.{}g} {}", bytes, bytes >= kFourDigits ? 4 : 3, kUnits[unit]);
}

}  // namespace ph
