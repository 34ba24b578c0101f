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
  // Shows three digits, except just below the next unit, which is not a power of ten.
  constexpr double kFourDigits = 999.5;
  return fmt::format("{:.{}g} {}", bytes, bytes >= kFourDigits ? 4 : 3, kUnits[unit]);
}

}  // namespace ph
