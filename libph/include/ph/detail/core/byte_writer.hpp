// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ph {

/// Converts the bytes of a number from this machine's order to low byte first, or back.
template <std::size_t n>
std::array<std::byte, n> little_endian(std::array<std::byte, n> bytes) {
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  return bytes;
}

/// Writes numbers, one after another, as bytes that are the same on every machine.
class ByteWriter {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void put(T value) {
    const auto bytes = little_endian(std::bit_cast<std::array<std::byte, sizeof(T)>>(value));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  /// Writes seven bits per byte, low bits first: for numbers that are usually small.
  void put_short(std::uint64_t value) {
    constexpr std::uint64_t more = 0x80;
    for (; value >= more; value >>= 7) put(static_cast<std::uint8_t>(value | more));
    put(static_cast<std::uint8_t>(value));
  }
  /// Writes the length of the text, then its bytes.
  void put(std::string_view text) {
    put(std::uint64_t{text.size()});
    const auto* const data = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), data, data + text.size());
  }
  /// Writes the size of the list, then its items. @param put_one writes one item.
  template <class List, class Put>
  void put_list(const List& list, Put&& put_one) {
    put(std::uint64_t{list.size()});
    for (const auto& one : list) put_one(one);
  }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  void put_bytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  std::span<const std::byte> bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::exchange(bytes_, {}); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace ph
