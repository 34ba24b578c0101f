// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string_view>

namespace ph {

/// The length of the UTF-8 sequence at the start of `text`, which must not be empty. It is 0 if the
/// sequence is invalid. Overlong forms, surrogates and code points beyond U+10FFFF are invalid.
inline std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  if (first == 0xe0 && byte(1) < 0xa0) return 0;
  if (first == 0xed && byte(1) > 0x9f) return 0;
  if (first == 0xf0 && byte(1) < 0x90) return 0;
  if (first == 0xf4 && byte(1) > 0x8f) return 0;
  return length;
}

/// The first byte of a text that is no UTF-8, if such bytes are more than a quarter of the text;
/// otherwise npos. A header in Latin-1 has a few letters with accents, but a volume of bytes
/// without a header has mostly such bytes.
inline std::size_t first_of_many_foreign_bytes(std::string_view text) {
  std::size_t foreign = 0, first = std::string_view::npos;
  for (std::size_t place = 0; place < text.size();) {
    const std::size_t length = utf8_length(text.substr(place));
    if (length == 0 && foreign++ == 0) first = place;
    place += length == 0 ? 1 : length;
  }
  return 4 * foreign > text.size() ? first : std::string_view::npos;
}

inline bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace ph
