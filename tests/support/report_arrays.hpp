// SPDX-License-Identifier: MIT
#pragma once
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ph::test {

/// Decodes base64 (RFC 4648). @throws std::runtime_error on an invalid character.
inline std::vector<std::uint8_t> base64_decoded(std::string_view text) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) throw std::runtime_error("a character is no base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

/// The numbers in the HTML element of a report that stores an array, read as the page reads them.
/// @throws std::runtime_error unless there are exactly `count` numbers.
template <class T>
std::vector<T> numbers_of(const std::string& element, std::size_t count, std::size_t columns) {
  const std::size_t begin = element.find('>') + 1, end = element.rfind("</script>");
  const auto packed = base64_decoded(std::string_view(element).substr(begin, end - begin));
  std::vector<std::uint8_t> bytes(count * sizeof(T) + 1);
  uLongf size = bytes.size();
  if (uncompress(bytes.data(), &size, packed.data(), packed.size()) != Z_OK ||
      size != count * sizeof(T))
    throw std::runtime_error("an array does not unpack to its size");
  std::vector<std::uint8_t> unplaned(count * sizeof(T));
  for (std::size_t k = 0; k < sizeof(T); ++k)
    for (std::size_t i = 0; i < count; ++i) unplaned[i * sizeof(T) + k] = bytes[k * count + i];
  std::vector<T> numbers(count);
  if (count > 0) std::memcpy(numbers.data(), unplaned.data(), unplaned.size());
  if (element.find("delta") < begin)
    for (std::size_t i = columns; i < count; ++i)
      numbers[i] = static_cast<T>(static_cast<std::uint64_t>(numbers[i]) +
                                  static_cast<std::uint64_t>(numbers[i - columns]));
  return numbers;
}

}  // namespace ph::test
