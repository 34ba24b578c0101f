// SPDX-License-Identifier: MIT
#include "ph/detail/io/base64.hpp"

#include <array>

namespace ph::detail {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::uint8_t kNoDigit = 64;

constexpr std::array<std::uint8_t, 256> values_of_digits() {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  for (std::size_t k = 0; k < kDigits.size(); ++k)
    values[static_cast<unsigned char>(kDigits[k])] = static_cast<std::uint8_t>(k);
  return values;
}
constexpr std::array<std::uint8_t, 256> kValues = values_of_digits();

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

std::size_t Base64Digits::read(std::span<std::byte> to) {
  for (std::size_t done = 0; done < to.size(); ++done) {
    if (count_ == 0 && !read_group()) return done;
    to[done] = static_cast<std::byte>(group_ >> 16 & 0xFF);
    group_ <<= 8;
    --count_;
  }
  return to.size();
}

bool Base64Digits::ended() const {
  return count_ == 0 && text_.find_first_not_of(kBlanks, used_) == std::string_view::npos;
}

// A group has four digits. The last ones may be padding, whose missing bits must be zero.
bool Base64Digits::read_group() {
  std::uint32_t bits = 0;
  int digits = 0, padding = 0;
  std::size_t at = used_;
  for (; digits + padding < 4; ++at) {
    if (at == text_.size()) return false;
    const char c = text_[at];
    if (kBlanks.find(c) != std::string_view::npos) continue;
    const std::uint8_t value = kValues[static_cast<unsigned char>(c)];
    if (c == '=' && digits >= 2) {
      ++padding;
      bits <<= 6;
    } else if (value != kNoDigit && padding == 0) {
      ++digits;
      bits = bits << 6 | value;
    } else {
      return false;
    }
  }
  if (padding > 0 && (bits & ((1U << 8 * padding) - 1)) != 0) return false;
  group_ = bits;
  count_ = 3 - padding;
  used_ = at;
  return true;
}

}  // namespace ph::detail
