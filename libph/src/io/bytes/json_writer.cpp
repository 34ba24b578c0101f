// SPDX-License-Identifier: MIT
#include "io/bytes/json_writer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ph/io/write.hpp"

namespace ph::json {
namespace {

/// Length of the UTF-8 sequence at the start of `text`; 0 if it is none (overlong forms,
/// surrogates and code points beyond U+10FFFF are none).
std::size_t utf8_length(std::string_view text) {
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

}  // namespace

std::string string(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0) {
      out += "\xef\xbf\xbd";  // U+FFFD
    } else if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out + "\"";
}

std::string number(double value) { return std::isfinite(value) ? shortest(value) : "null"; }

void add_members(std::string& text, Members members, std::string_view between) {
  for (const auto& [name, value] : members) {
    if (value.empty()) continue;
    if (!text.empty()) text += between;
    text += string(name) + ": " + value;
  }
}

std::string object(Members members) {
  std::string text;
  add_members(text, members);
  return "{" + text + "}";
}

std::string document(Members members) {
  std::string text;
  add_members(text, members, ",\n  ");
  return "{\n  " + text + "\n}\n";
}

}  // namespace ph::json
