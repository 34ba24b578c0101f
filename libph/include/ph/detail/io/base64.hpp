// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

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

}  // namespace ph::detail
