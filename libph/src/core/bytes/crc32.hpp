// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ph {

/// The checksum of zip, PNG and Ethernet: CRC-32 with the reversed polynomial 0xEDB88320. It is
/// implemented here because the core does not depend on zlib.
inline std::uint32_t crc32(std::span<const std::byte> bytes) {
  // Processes eight bytes at a time. Each of the eight positions has its own table, which takes the
  // bytes after this position into account (Kounavis & Berry, Novel table lookup-based algorithms
  // for high-performance CRC generation, 2008).
  constexpr std::size_t kAtOnce = 8;
  static constexpr auto kTables = [] {
    std::array<std::array<std::uint32_t, 256>, kAtOnce> tables{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit)
        value = (value & 1) != 0 ? 0xEDB88320U ^ (value >> 1) : value >> 1;
      tables[0][i] = value;
    }
    for (std::size_t k = 1; k < kAtOnce; ++k)
      for (std::uint32_t i = 0; i < 256; ++i)
        tables[k][i] = tables[0][tables[k - 1][i] & 0xFF] ^ (tables[k - 1][i] >> 8);
    return tables;
  }();
  std::uint32_t value = ~std::uint32_t{0};
  const auto byte = [](std::byte b) { return static_cast<std::uint32_t>(b); };
  for (; bytes.size() >= kAtOnce; bytes = bytes.subspan(kAtOnce)) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      const std::uint32_t before = i < 4 ? value >> (8 * i) : 0;
      next ^= kTables[kAtOnce - 1 - i][(byte(bytes[i]) ^ before) & 0xFF];
    }
    value = next;
  }
  for (const std::byte b : bytes) value = kTables[0][(value ^ byte(b)) & 0xFF] ^ (value >> 8);
  return ~value;
}

}  // namespace ph
