// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace ph {

/// A value of an enum with its name on command lines, in Python and in files.
template <class Enum>
struct Named {
  Enum value;
  std::string_view name;
};

/// The values of an enum with their names, in the order of the help. A specialisation for each enum
/// with names stands next to the enum's definition.
template <class Enum>
inline constexpr std::array<Named<Enum>, 0> names_of{};

/// All names of an enum.
template <class Enum>
inline constexpr auto all_names = [] {
  std::array<std::string_view, names_of<Enum>.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = names_of<Enum>[i].name;
  return names;
}();

/// The name of a value; empty if it has none.
template <class Enum>
constexpr std::string_view name_of(Enum value) {
  for (const Named<Enum>& known : names_of<Enum>)
    if (known.value == value) return known.name;
  return {};
}

/// The value with this name; empty if no value has it.
template <class Enum>
constexpr std::optional<Enum> value_named(std::string_view name) {
  for (const Named<Enum>& known : names_of<Enum>)
    if (known.name == name) return known.value;
  return std::nullopt;
}

}  // namespace ph
