// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ph {

/// The checksum of zip, PNG and Ethernet: CRC-32 with the reversed polynomial 0xEDB88320. For the
/// core, which needs no zlib.
inline std::uint32_t crc32(std::span<const std::byte> bytes) {
  static constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit)
        value = (value & 1) != 0 ? 0xEDB88320U ^ (value >> 1) : value >> 1;
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t value = ~std::uint32_t{0};
  for (const std::byte byte : bytes)
    value = kTable[(value ^ static_cast<std::uint32_t>(byte)) & 0xFF] ^ (value >> 8);
  return ~value;
}

}  // namespace ph
