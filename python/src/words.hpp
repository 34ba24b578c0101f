// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/error.hpp"

namespace ph::python {

/// A keyword with a value, as it is: "nan", "drop".
struct Keyword {
  std::string name;  ///< empty: no function takes what the setting sets
  std::string value;
};
/// What sets the same in Python. Some settings have another name there, or another value.
Keyword keyword_of(Setting setting, std::string_view value);

/// Settings as keywords: "nan='drop'".
extern const Words kWords;

}  // namespace ph::python
