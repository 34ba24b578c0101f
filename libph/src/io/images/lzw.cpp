// SPDX-License-Identifier: MIT
// LZW as in TIFF 6.0, section 13: codes of 9 to 12 bits, the first bit is the highest one.
#include <array>

#include "libph/src/io/images/tiff.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kClear = 256, kEnd = 257, kFirst = 258, kCodes = 4096;

// The strings of the codes. The string of a code is the string of a shorter code, and one byte.
struct Strings {
  std::array<std::uint16_t, kCodes> shorter;
  std::array<std::uint16_t, kCodes> length;
  std::array<std::byte, kCodes> last, first;

  Strings() {
    for (std::size_t code = 0; code < kClear; ++code) {
      length[code] = 1;
      first[code] = last[code] = static_cast<std::byte>(code);
    }
  }
  void add(std::size_t code, std::size_t before, std::byte byte) {
    shorter[code] = static_cast<std::uint16_t>(before);
    length[code] = static_cast<std::uint16_t>(length[before] + 1);
    first[code] = first[before];
    last[code] = byte;
  }
};

}  // namespace

std::optional<std::size_t> unpack_lzw(std::span<const std::byte> from, std::span<std::byte> to,
                                      bool& more) {
  Strings strings;
  std::size_t done = 0, next = kFirst, width = 9, before = kClear;
  std::uint32_t waiting = 0;  // bits that are read, the latest bit lowest
  std::size_t bits = 0;
  for (const std::byte byte : from) {
    waiting = waiting << 8 | std::to_integer<std::uint32_t>(byte);
    bits += 8;
    if (bits < width) continue;
    bits -= width;
    const std::size_t code = waiting >> bits & ((std::uint32_t{1} << width) - 1);
    if (code == kEnd) break;
    if (code == kClear) {
      next = kFirst;
      width = 9;
      before = kClear;
      continue;
    }
    if (done == to.size()) {
      more = true;
      break;
    }
    if (before == kClear) {
      if (code > kClear) return std::nullopt;
    } else if (next < kCodes) {
      if (code > next) return std::nullopt;
      strings.add(next, before, strings.first[code == next ? before : code]);
      ++next;
    } else if (code >= next) {
      return std::nullopt;
    }
    const std::size_t length = strings.length[code];
    const std::size_t kept = std::min(length, to.size() - done);
    more = more || kept < length;
    std::size_t part = code;
    for (std::size_t k = length; k-- > 0; part = strings.shorter[part])
      if (k < kept) to[done + k] = strings.last[part];
    done += kept;
    before = code;
    // The width grows one code early.
    if (next + 1 == std::size_t{1} << width && width < 12) ++width;
  }
  return done;
}

}  // namespace ph::detail
