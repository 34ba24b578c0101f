// SPDX-License-Identifier: MIT
#include "ph/detail/io/json_writer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libph/src/io/bytes/utf8.hpp"
#include "ph/io/write.hpp"

namespace ph::json {
std::string string(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0) {
      out += "\xef\xbf\xbd";  // the replacement character U+FFFD
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
