// SPDX-License-Identifier: MIT
#include "python/src/calls/words.hpp"

namespace ph::python {
namespace {

bool is_number(std::string_view text) {
  return text.find_first_not_of("+-.0123456789e") == text.npos;
}

/// True for a placeholder, such as X. The reader of the message knows which value to give instead.
bool is_placeholder(std::string_view value) { return value[0] >= 'A' && value[0] <= 'Z'; }

std::string in_keywords(Setting setting, std::string_view value) {
  const auto [name, given] = keyword_of(setting, value);
  if (name.empty() || given.empty()) return name;
  // A camera and a placeholder are written without quotes.
  if (setting == Setting::camera || is_placeholder(given)) return name + ' ' + given;
  if (setting == Setting::columns) {
    std::string columns;
    for (const char c : given) columns += c == ',' ? "', '" : std::string(1, c);
    return name + "=['" + columns + "']";
  }
  if (is_number(given)) return name + '=' + given;
  if (given.find(',') == given.npos) return name + '=' + alternatives(given, "'");
  std::string numbers;
  for (const char c : given) (numbers += c) += c == ',' ? " " : "";
  return name + "=(" + numbers + ')';
}

}  // namespace

Keyword keyword_of(Setting setting, std::string_view value) {
  const auto named = [&](std::string_view name) {
    return Keyword{std::string(name), std::string(value)};
  };
  switch (setting) {
    case Setting::allow_empty:  // this option is always on
    case Setting::labels:       // used for a label file, which Python does not write
    case Setting::plane_guess:
    case Setting::report:
      return {};
    case Setting::complex:
      return {"array", value == "cubical" ? "image" : std::string(value)};
    case Setting::diagonal:
      return {"diagonal", value == "zero" ? "any" : std::string(value)};
    case Setting::cut:  // this is the first parameter of Segmentation.cut
      return named("value");
    case Setting::infinite:
      return named("infinity");
    case Setting::raw_type:
      return named("raw_dtype");
    case Setting::most_supports:
      return named("plane");
    case Setting::spacing:
      return named("supervoxels");
    default:
      return named(name_of(setting));
  }
}

const Words kWords{&in_keywords};

}  // namespace ph::python
