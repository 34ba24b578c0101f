// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// Walks through a JSON text once, value by value, without building a tree. Every function throws
/// Error (bad_data) "name:line:column: …" if the text is not JSON, or not what the function
/// requires.
class JsonCursor {
 public:
  explicit JsonCursor(const Input& input) : text_(input.text()), input_(input) {}

  /// The first byte of the next value or punctuation mark, without taking it; NUL at the end.
  char peek();
  /// Takes the punctuation mark if it comes next. @return true if it did.
  bool accept(char mark);
  void expect(char mark);
  /// Takes the word null if it comes next. @return true if it did.
  bool accept_null();
  /// Takes an object. `take` is called with the name of each member, and takes its value.
  template <class Take>
  void for_each_member(Take&& take) {
    expect('{');
    std::string name;
    for (bool first = true; next_member(first, name);) take(std::as_const(name));
  }
  /// Takes an array. `take` is called for each element, and takes it.
  template <class Take>
  void for_each_element(Take&& take) {
    expect('[');
    for (bool first = true; next_element(first);) take();
  }

  bool boolean();
  /// A string with its escapes decoded; \u becomes UTF-8.
  std::string string();
  double number();
  std::int64_t integer(std::int64_t least, std::int64_t most, const char* what);
  /// Takes a value of any kind.
  void skip_value(int depth = 0);
  /// Requires that only blanks follow up to the end.
  void expect_end();

  std::size_t place() const { return at_; }
  /// The line and the column of a place, from 1.
  std::pair<std::size_t, std::size_t> line_and_column(std::size_t place) const;
  [[noreturn]] void fail(std::size_t place, const Fault& fault) const;

 private:
  /// Goes to the next member of an object whose '{' was taken: takes the member's name and the
  /// colon. @return false at the object's '}'.
  /// @param first true for the first member; the cursor sets it to false.
  bool next_member(bool& first, std::string& name);
  /// Goes to the next element of an array whose '[' was taken; `first` is as in next_member.
  /// @return false at the array's ']'.
  bool next_element(bool& first);
  bool accept_word(std::string_view word);
  std::string found();
  std::string_view number_word();
  std::uint32_t hex4();
  // The code point after a \u that was taken; an unpaired surrogate becomes U+FFFD.
  std::uint32_t escaped_code();

  std::string_view text_;
  const Input& input_;
  std::size_t at_ = 0;
};

}  // namespace ph::detail
