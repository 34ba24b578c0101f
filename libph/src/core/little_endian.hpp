// SPDX-License-Identifier: MIT
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "ph/error.hpp"

namespace ph {

/// The bytes of a number, the low one first.
template <class T>
std::array<std::byte, sizeof(T)> in_order(std::array<std::byte, sizeof(T)> bytes) {
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  return bytes;
}

/// Tells bytes from others that are not made to deceive (Fowler, Noll, Vo: FNV-1a).
inline std::uint64_t hash_of(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte byte : bytes)
    hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
  return hash;
}

/// Numbers as bytes, the same on every machine.
class ByteWriter {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void put(T value) {
    const auto bytes = in_order<T>(std::bit_cast<std::array<std::byte, sizeof(T)>>(value));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  template <class List, class Put>
  void put_list(const List& list, Put&& put_one) {
    put(std::uint64_t{list.size()});
    for (const auto& one : list) put_one(one);
  }
  void put_bytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  std::span<const std::byte> bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::exchange(bytes_, {}); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads what ByteWriter wrote. All functions throw Error (bad_data) where bytes are none of it.
class ByteReader {
 public:
  /// @param of what the bytes are, for errors.
  ByteReader(std::span<const std::byte> bytes, const char* of) : bytes_(bytes), of_(of) {}

  [[noreturn]] void refuse(const char* what) const {
    throw Error(ErrorKind::bad_data, fmt::format("{}: found a damaged {}", of_, what));
  }
  template <class T>
  T get(const char* what) {
    if (bytes_.size() - at_ < sizeof(T)) refuse(what);
    std::array<std::byte, sizeof(T)> bytes;
    std::ranges::copy(bytes_.subspan(at_, sizeof(T)), bytes.begin());
    at_ += sizeof(T);
    return std::bit_cast<T>(in_order<T>(bytes));
  }
  bool flag(const char* what) {
    const auto value = get<std::uint8_t>(what);
    if (value > 1) refuse(what);
    return value != 0;
  }
  /// Of things that take that many bytes each, at least.
  std::size_t count(std::size_t bytes_each, const char* what) {
    const auto count = get<std::uint64_t>(what);
    if (count > (bytes_.size() - at_) / bytes_each) refuse(what);
    return static_cast<std::size_t>(count);
  }
  /// So many bytes have been read.
  std::size_t at() const { return at_; }
  void expect_end() const {
    if (at_ != bytes_.size()) refuse("end");
  }

 private:
  std::span<const std::byte> bytes_;
  const char* of_;
  std::size_t at_ = 0;
};

}  // namespace ph
