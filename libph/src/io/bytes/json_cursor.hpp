// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// Walks through a JSON text once, value by value, without building anything. Every function throws
/// Error (bad_data) "name:line:column: …" on what is not JSON or not what it was asked for.
class JsonCursor {
 public:
  explicit JsonCursor(const Input& input) : text_(input.text()), input_(input) {}

  /// The first byte of the next value or mark, not taken; NUL at the end.
  char peek();
  /// Takes the mark, if it comes next.
  bool accept(char mark);
  void expect(char mark);
  /// Takes the word null, if it comes next.
  bool accept_null();
  /// The next member of an object whose '{' was taken: its name, with the colon; false at its '}'.
  /// @param first whether it is the first one; the cursor sets it to false.
  bool next_member(bool& first, std::string& name);
  /// The same for the elements of an array whose '[' was taken.
  bool next_element(bool& first);

  bool boolean();
  /// A string without its escapes; \u becomes UTF-8.
  std::string string();
  double number();
  std::int64_t integer(std::int64_t least, std::int64_t most, const char* what);
  /// Takes a value whatever it is.
  void skip_value(int depth = 0);
  /// Expects nothing but blanks up to the end.
  void expect_end();

  std::size_t place() const { return at_; }
  [[noreturn]] void fail(std::size_t place, const Fault& fault) const;

 private:
  bool accept_word(std::string_view word);
  std::string found();
  std::string_view number_word();
  std::uint32_t hex4();
  std::uint32_t escaped_code();  // of a \u that was taken; half of a pair is U+FFFD

  std::string_view text_;
  const Input& input_;
  std::size_t at_ = 0;
};

}  // namespace ph::detail
