// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/error.hpp"

namespace ph::python {

/// A keyword with a literal value, such as "nan" and "drop".
struct Keyword {
  std::string name;  ///< empty if no function has a keyword for the setting
  std::string value;
};
/// The Python keyword for a setting. Some settings have another name or another value in Python.
Keyword keyword_of(Setting setting, std::string_view value);

/// Writes settings as keywords, such as "nan='drop'".
extern const Words kWords;

}  // namespace ph::python
