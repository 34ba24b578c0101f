// SPDX-License-Identifier: MIT
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ph/detail/core/byte_writer.hpp"
#include "ph/error.hpp"

namespace ph {

/// Reads the output of a ByteWriter without trusting it: a forged count cannot make the reader
/// allocate more memory than the bytes themselves take.
class ByteReader {
 public:
  /// @param of the name of the data, for messages: "part of an image".
  ByteReader(std::span<const std::byte> bytes, std::string_view of) : bytes_(bytes), of_(of) {}

  /// Throws Error (bad_data) for damaged data, such as "part of an image: found a damaged seam".
  [[noreturn]] void refuse(std::string_view what) const {
    throw Error(ErrorKind::bad_data, fmt::format("{}: found a damaged {}", of_, what));
  }
  /// @throws Error (bad_data) as refuse, if there are too few bytes.
  template <class T>
  T get(std::string_view what) {
    if (bytes_.size() - at_ < sizeof(T)) refuse(what);
    std::array<std::byte, sizeof(T)> bytes;
    std::ranges::copy(bytes_.subspan(at_, sizeof(T)), bytes.begin());
    at_ += sizeof(T);
    return std::bit_cast<T>(little_endian(bytes));
  }
  /// Reads a filtration value; refuses NaN, because NaN has no place in any order.
  double value(std::string_view what) {
    const auto value = get<double>(what);
    if (std::isnan(value)) refuse(what);  // mutant: part-nan
    return value;
  }
  std::uint64_t get_short(std::string_view what) {
    for (std::uint64_t value = 0, shift = 0; shift < 64; shift += 7) {
      const auto byte = get<std::uint8_t>(what);
      const std::uint64_t bits = byte & 0x7FU;
      if (bits << shift >> shift != bits) refuse(what);
      value |= bits << shift;
      if (byte < 0x80) return value;
    }
    refuse(what);
  }
  bool flag(std::string_view what) {
    const auto value = get<std::uint8_t>(what);
    if (value > 1) refuse(what);
    return value != 0;
  }
  /// Reads a count of items that take at least `bytes_each` bytes each; refuses the count if the
  /// remaining bytes cannot hold this many items.
  std::size_t count(std::size_t bytes_each, std::string_view what) {
    const auto count = get<std::uint64_t>(what);
    if (count > (bytes_.size() - at_) / bytes_each) refuse(what);
    return static_cast<std::size_t>(count);
  }
  std::string text(std::string_view what) {
    const std::size_t size = count(1, what);
    const auto* const data = reinterpret_cast<const char*>(bytes_.data() + at_);
    at_ += size;
    return {data, size};
  }
  /// The number of bytes read.
  std::size_t at() const { return at_; }
  void expect_end() const {
    if (at_ != bytes_.size()) refuse("end");
  }

 private:
  std::span<const std::byte> bytes_;
  std::string_view of_;
  std::size_t at_ = 0;
};

}  // namespace ph
