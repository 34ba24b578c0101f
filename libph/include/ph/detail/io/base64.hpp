// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ph::detail {

/// Bytes as text, piece by piece: RFC 4648, padded, without line breaks.
class Base64 {
 public:
  /// Appends the text that these bytes complete; up to two bytes wait for more.
  void append(std::span<const std::byte> bytes, std::string& text);
  /// Appends the rest and its padding. Bytes after that begin a new text.
  void finish(std::string& text);

 private:
  std::uint32_t waiting_ = 0;  // the bits that wait for more bytes
  int count_ = 0;              // number of waiting bytes
};

/// The bytes of a Base64 text, which may be several padded texts, one after another. Blanks and
/// line ends are skipped.
class Base64Digits {
 public:
  /// The text must outlive the object.
  explicit Base64Digits(std::string_view text) : text_(text) {}

  /// Reads bytes until `to` is full. @return the number of bytes. It is smaller than the size of
  /// `to` if the text ends or is damaged.
  std::size_t read(std::span<std::byte> to);
  /// The number of characters that were read, up to the first group of four that is damaged.
  std::size_t used() const { return used_; }
  /// True if the group that was read last has more bytes.
  bool has_more() const { return count_ > 0; }
  /// True if no group follows.
  bool ended() const;

 private:
  bool read_group();

  std::string_view text_;
  std::size_t used_ = 0;
  std::uint32_t group_ = 0;  // the bytes of the group, the next one in the bits from 16 to 23
  int count_ = 0;            // number of bytes left in the group
};

}  // namespace ph::detail
