// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// The name most similar to the typed name, if it is similar enough to be what the user meant.
std::optional<std::string_view> nearest_name(std::string_view typed,
                                             std::span<const std::string_view> names);

/// The position of a word in a list of choices.
/// @throws Error (usage): `option: found 'word', expected one of a, b, c; did you mean 'b'?`
std::size_t choose(std::string_view option, std::string_view word,
                   std::span<const std::string_view> choices);

}  // namespace ph::app
