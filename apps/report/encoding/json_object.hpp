// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/io/write.hpp"

namespace ph::report {

/// An object of JSON, member by member. What is empty is left out.
class JsonObject {
 public:
  /// @param json a value as JSON.
  JsonObject& add(std::string_view name, std::string_view json) {
    if (json.empty()) return *this;
    text_ += text_.empty() ? "" : ", ";
    text_ += json_string(name);
    text_ += ": ";
    text_ += json;
    return *this;
  }
  JsonObject& text(std::string_view name, std::string_view value) {
    return value.empty() ? *this : add(name, json_string(value));
  }
  std::string str() const { return "{" + text_ + "}"; }
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

/// null if it is infinite.
inline std::string json_number(double value) {
  return std::isfinite(value) ? shortest(value) : "null";
}

/// An array of what `write` makes of each value; empty without values.
template <class Values, class Write>
std::string json_array(const Values& values, Write&& write) {
  std::string text;
  for (const auto& value : values) {
    text += text.empty() ? "[" : ", ";
    text += write(value);
  }
  return text.empty() ? text : text + "]";
}

}  // namespace ph::report
