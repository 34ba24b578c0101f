// SPDX-License-Identifier: MIT
#include "ph/detail/io/base64.hpp"

#include <string_view>

namespace ph::detail {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

void Base64::append(std::span<const std::byte> bytes, std::string& text) {
  for (const std::byte byte : bytes) {
    waiting_ = waiting_ << 8 | std::to_integer<std::uint32_t>(byte);
    if (++count_ < 3) continue;
    for (const int shift : {18, 12, 6, 0}) text += kDigits[waiting_ >> shift & 63];
    waiting_ = 0;
    count_ = 0;
  }
}

void Base64::finish(std::string& text) {
  if (count_ == 0) return;
  const std::uint32_t bits = waiting_ << 8 * (3 - count_);
  for (int digit = 0; digit < 4; ++digit)
    text += digit <= count_ ? kDigits[bits >> (18 - 6 * digit) & 63] : '=';
  waiting_ = 0;
  count_ = 0;
}

}  // namespace ph::detail
