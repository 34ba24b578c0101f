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
  // Sizes have three digits, or four from 1000 up to the next unit, because units are powers of
  // 1024.
  constexpr double kFourDigits = 999.5;
  return fmt::format("{:.{}g} {}", bytes, bytes >= kFourDigits ? 4 : 3, kUnits[unit]);
}

}  // namespace ph
