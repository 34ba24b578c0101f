// SPDX-License-Identifier: MIT
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "ph/io/write.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment::json {

// Values are JSON texts. No tree of values is built: the usual ones allocate in their destructors.
using Members = std::initializer_list<std::pair<std::string_view, std::string>>;

inline std::string number(double value) { return std::isfinite(value) ? shortest(value) : "null"; }
inline std::string integer(Index value) { return fmt::format("{}", value); }
inline std::string boolean(bool value) { return value ? "true" : "false"; }

/// `between` stands between the members: ", " for one line.
inline std::string object(Members members, std::string_view between = ", ") {
  std::string text;
  for (const auto& [key, value] : members) {
    if (!text.empty()) text += between;
    text += fmt::format("{}: {}", json_string(key), value);
  }
  return fmt::format("{{{}}}", text);
}

inline std::string numbers(const Vec3& values) {
  return fmt::format("[{}, {}, {}]", number(values[0]), number(values[1]), number(values[2]));
}

/// An array with an element a line.
template <class Values, class Write>
std::string lines(const Values& values, Write&& write) {
  std::string text;
  for (const auto& value : values) {
    text += text.empty() ? "\n    " : ",\n    ";
    text += write(value);
  }
  return fmt::format("[{}{}]", text, text.empty() ? "" : "\n  ");
}

/// A whole file: an object with a member a line.
inline std::string document(Members members) {
  const std::string text = object(members, ",\n  ");
  return fmt::format("{{\n  {}\n}}\n", std::string_view(text).substr(1, text.size() - 2));
}

inline std::string method(Method method) {
  return json_string(kMethodNames[static_cast<std::size_t>(method)]);
}
inline std::string cut(const CutOptions& o) {
  return object({{"value", number(o.value)},
                 {"min_part", integer(o.min_part)},
                 {"min_size", integer(o.min_size)},
                 {"objects", boolean(o.objects)}});
}

}  // namespace ph::segment::json
