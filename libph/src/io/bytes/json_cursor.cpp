// SPDX-License-Identifier: MIT
#include "ph/detail/io/json_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "ph/detail/core/floating.hpp"

namespace ph::detail {
namespace {

constexpr int kMostDepth = 64;  // the nesting depth of a skipped value

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 0x3F));
  } else {
    if (code < 0x10000) {
      put(0xE0 | code >> 12);
    } else {
      put(0xF0 | code >> 18);
      put(0x80 | (code >> 12 & 0x3F));
    }
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

/// Removes the digits at the start of `word`. @return true if there are digits.
bool take_digits(std::string_view& word) {
  const std::size_t end = std::min(word.find_first_not_of("0123456789"), word.size());
  word.remove_prefix(end);
  return end > 0;
}

/// Follows RFC 8259. A number has no leading zero before other digits, and has digits on both sides
/// of a decimal point.
bool is_json_number(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  if (word.size() > 1 && word[0] == '0' && word[1] >= '0' && word[1] <= '9') return false;
  if (!take_digits(word)) return false;
  if (word.starts_with('.')) {
    word.remove_prefix(1);
    if (!take_digits(word)) return false;
  }
  if (word.empty()) return true;
  if (word[0] != 'e' && word[0] != 'E') return false;
  word.remove_prefix(1);
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  return take_digits(word) && word.empty();
}

}  // namespace

std::pair<std::size_t, std::size_t> JsonCursor::line_and_column(std::size_t place) const {
  const std::string_view before = text_.substr(0, place);
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  const std::size_t start = before.rfind('\n');
  return {line, start == std::string_view::npos ? place + 1 : place - start};
}

void JsonCursor::fail(std::size_t place, const Fault& fault) const {
  const auto [line, column] = line_and_column(place);
  input_.fail_at(line, column, fault);
}

std::string JsonCursor::found() {
  return peek() == '\0' && at_ == text_.size() ? "the end of the file"
                                               : '\'' + printable(text_.substr(at_, 1)) + '\'';
}

char JsonCursor::peek() {
  while (at_ < text_.size() &&
         (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t')) {
    ++at_;
  }
  return at_ < text_.size() ? text_[at_] : '\0';
}

bool JsonCursor::accept(char mark) {
  if (peek() != mark || at_ == text_.size()) return false;
  ++at_;
  return true;
}

void JsonCursor::expect(char mark) {
  if (!accept(mark)) fail(at_, {"JSON", found(), fmt::format("'{}'", mark), {}});
}

bool JsonCursor::accept_word(std::string_view word) {
  peek();
  if (text_.substr(at_, word.size()) != word) return false;
  at_ += word.size();
  return true;
}

bool JsonCursor::accept_null() { return accept_word("null"); }

bool JsonCursor::boolean() {
  if (accept_word("true")) return true;
  if (accept_word("false")) return false;
  fail(at_, {"JSON value", found(), "true or false", {}});
}

bool JsonCursor::next_member(bool& first, std::string& name) {
  if (accept('}')) return false;
  if (!first) expect(',');
  first = false;
  name = string();
  expect(':');
  return true;
}

bool JsonCursor::next_element(bool& first) {
  if (accept(']')) return false;
  if (!first) expect(',');
  first = false;
  return true;
}

std::uint32_t JsonCursor::hex4() {
  std::uint32_t code = 0;
  const std::string_view digits = text_.substr(at_, 4);
  const auto [stop, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
  if (digits.size() != 4 || error != std::errc{} || stop != digits.data() + 4) {
    fail(at_, {"JSON string", printable(digits), "four hexadecimal digits", {}});
  }
  at_ += 4;
  return code;
}

std::uint32_t JsonCursor::escaped_code() {
  constexpr std::uint32_t replacement = 0xFFFD;
  const auto is_half = [](std::uint32_t code, std::uint32_t first) {
    return code >= first && code < first + 0x400;
  };
  const std::uint32_t code = hex4();
  if (is_half(code, 0xD800) && text_.substr(at_, 2) == "\\u") {
    const std::size_t behind = at_;
    at_ += 2;
    const std::uint32_t second = hex4();
    if (is_half(second, 0xDC00)) return 0x10000 + ((code & 0x3FF) << 10) + (second & 0x3FF);
    at_ = behind;
  }
  return is_half(code, 0xD800) || is_half(code, 0xDC00) ? replacement : code;
}

std::string JsonCursor::string() {
  expect('"');
  const std::size_t begin = at_;
  std::string result;
  while (at_ < text_.size() && text_[at_] != '"') {
    const char c = text_[at_++];
    if (static_cast<unsigned char>(c) < 0x20) {
      fail(at_ - 1, {"JSON string", "a control character", "a closing quote", {}});
    }
    if (c != '\\' || at_ == text_.size()) {
      result += c;
      continue;
    }
    const char escape = text_[at_++];
    constexpr std::string_view kFrom = "\"\\/bfnrt", kTo = "\"\\/\b\f\n\r\t";
    if (const std::size_t known = kFrom.find(escape); known != std::string_view::npos) {
      result += kTo[known];
    } else if (escape == 'u') {
      append_utf8(result, escaped_code());
    } else {
      fail(at_ - 1, {"JSON string", "an unknown escape", "one of \" \\ / b f n r t u", {}});
    }
  }
  if (at_ == text_.size()) fail(begin, {"JSON string", "no closing quote", "one", {}});
  ++at_;
  return result;
}

std::string_view JsonCursor::number_word() {
  peek();
  const std::size_t stop = std::min(text_.find_first_not_of("+-0123456789.eE", at_), text_.size());
  const std::string_view word = text_.substr(at_, stop - at_);
  if (word.empty() || word[0] == '+') fail(at_, {"JSON", found(), "a number", {}});
  if (!is_json_number(word)) fail(at_, {"not a JSON number", printable(word, 40), "a number", {}});
  return word;
}

double JsonCursor::number() {
  const std::string_view word = number_word();
  double value = 0;
  const auto [stop, error] = floating_from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || stop != word.data() + word.size()) {
    fail(at_, {"number out of range", printable(word, 40), "a number", {}});
  }
  at_ += word.size();
  return value + 0.0;
}

std::int64_t JsonCursor::integer(std::int64_t least, std::int64_t most, const char* what) {
  const std::string_view word = number_word();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || stop != word.data() + word.size() || value < least || value > most) {
    fail(at_, {fmt::format("{} out of range", what),
               printable(word, 40),
               fmt::format("an integer from {} to {}", least, most),
               {}});
  }
  at_ += word.size();
  return value;
}

void JsonCursor::skip_value(int depth) {
  if (depth > kMostDepth) {
    fail(at_,
         {"JSON", "values nested too deeply", fmt::format("at most {} levels", kMostDepth), {}});
  }
  bool first = true;
  std::string name;
  if (accept('{')) {
    while (next_member(first, name)) skip_value(depth + 1);
  } else if (accept('[')) {
    while (next_element(first)) skip_value(depth + 1);
  } else if (peek() == '"') {
    string();
  } else if (!accept_null() && !accept_word("true") && !accept_word("false")) {
    number();
  }
}

void JsonCursor::expect_end() {
  if (peek() != '\0' || at_ != text_.size()) {
    fail(at_, {"trailing data", found(), "the end of the file", {}});
  }
}

}  // namespace ph::detail
