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

namespace ph::parts {

/// The bytes of a number, the low one first.
template <class T>
std::array<std::byte, sizeof(T)> in_order(std::array<std::byte, sizeof(T)> bytes) {
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  return bytes;
}

/// Changes with any bit.
inline std::uint64_t sum_of(std::span<const std::byte> bytes) {
  std::uint64_t sum = bytes.size();
  const auto add = [&](std::uint64_t next) {
    sum = (sum ^ next) * 0x9E3779B97F4A7C15U;
    sum ^= sum >> 32;
  };
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::array<std::byte, 8> eight;
    std::ranges::copy(bytes.subspan(i, 8), eight.begin());
    add(std::bit_cast<std::uint64_t>(in_order<std::uint64_t>(eight)));
  }
  for (; i < bytes.size(); ++i) add(std::to_integer<std::uint64_t>(bytes[i]));
  return sum;
}

/// A part as bytes, little endian.
class Bytes {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void put(T value) {
    const auto bytes = in_order<T>(std::bit_cast<std::array<std::byte, sizeof(T)>>(value));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  /// Seven bits a byte, the low ones first: for numbers that are small as a rule.
  void put_short(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) put(static_cast<std::uint8_t>(value | 0x80));
    put(static_cast<std::uint8_t>(value));
  }
  template <class List, class Put>
  void put_list(const List& list, Put&& put_one) {
    put(std::uint64_t{list.size()});
    for (const auto& one : list) put_one(one);
  }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  std::span<const std::byte> view() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads what Bytes wrote, and believes none of it.
class Reader {
 public:
  /// @param whole what the bytes are, for messages.
  Reader(std::span<const std::byte> bytes, const char* whole) : bytes_(bytes), whole_(whole) {}
  template <class T>
  T get(const char* what) {
    if (bytes_.size() - at_ < sizeof(T)) refuse(what);
    std::array<std::byte, sizeof(T)> bytes;
    std::ranges::copy(bytes_.subspan(at_, sizeof(T)), bytes.begin());
    at_ += sizeof(T);
    return std::bit_cast<T>(in_order<T>(bytes));
  }
  std::uint64_t get_short(const char* what) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = get<std::uint8_t>(what);
      const std::uint64_t bits = byte & 0x7FU;
      if (bits << shift >> shift != bits) refuse(what);
      value |= bits << shift;
      if (byte < 0x80) return value;
    }
    refuse(what);
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
  void expect_end() const {
    if (at_ != bytes_.size()) refuse("end");
  }
  [[noreturn]] void refuse(const char* what) const {
    throw Error(ErrorKind::bad_data, fmt::format("{}: found a damaged {}", whole_, what));
  }

 private:
  std::span<const std::byte> bytes_;
  const char* whole_;
  std::size_t at_ = 0;
};

}  // namespace ph::parts
