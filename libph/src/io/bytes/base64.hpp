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
  /// Appends to `text` what these bytes complete; up to two of them wait for more.
  void append(std::span<const std::byte> bytes, std::string& text);
  /// Appends the rest and its padding. What comes next is a text of its own.
  void finish(std::string& text);

 private:
  std::uint32_t waiting_ = 0;  // bits
  int count_ = 0;              // bytes of them
};

}  // namespace ph::detail
