// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace ph::json {

// A value is represented by its JSON text. No tree of values is built, because the usual tree
// classes allocate in their destructors.

/// A string with its quotes. Bytes that are not UTF-8 become U+FFFD.
std::string string(std::string_view text);
/// The shortest text that reads back to the same double, or null if it is not finite.
std::string number(double value);
template <std::integral T>
std::string integer(T value) {
  return std::to_string(value);
}
inline std::string boolean(bool value) { return value ? "true" : "false"; }

/// A name and a value. A member without a value is left out.
using Members = std::initializer_list<std::pair<std::string_view, std::string>>;

/// Appends members to the text of an object, which is given without its braces.
/// @param between separates members: ", " for one line.
void add_members(std::string& text, Members members, std::string_view between = ", ");
/// An object on one line.
std::string object(Members members);
/// An entire file: an object with one member per line.
std::string document(Members members);

/// An array of the texts that `write` makes from the values, on one line.
template <class Values, class Write>
std::string array(const Values& values, Write&& write) {
  std::string text;
  for (const auto& value : values) {
    text += text.empty() ? "[" : ", ";
    text += write(value);
  }
  return text.empty() ? "[]" : text + "]";
}
template <class Values>
std::string numbers(const Values& values) {
  return array(values, number);
}
/// An array with one element per line, as a member of a document.
template <class Values, class Write>
std::string lines(const Values& values, Write&& write) {
  std::string text;
  for (const auto& value : values) {
    text += text.empty() ? "[\n    " : ",\n    ";
    text += write(value);
  }
  return text.empty() ? "[]" : text + "\n  ]";
}

}  // namespace ph::json
