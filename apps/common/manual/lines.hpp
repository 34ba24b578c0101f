// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// The words of a text, at its blanks.
std::vector<std::string_view> words_of(std::string_view text);

/// Breaks a text at its blanks into lines of at most so many characters, if its words are no
/// longer.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns);

/// The same for a list of alternatives, a|b|c: behind its bars.
std::vector<std::string> wrapped_list(std::string_view text, std::size_t columns);

/// How many columns a terminal needs for it: UTF-8, without wide characters.
std::size_t columns_of(std::string_view text);

/// With each of the characters behind a backslash.
std::string with_backslashes(std::string_view text, std::string_view characters);

/// In single quotes, as POSIX shells and zsh read it.
std::string shell_quoted(std::string_view text);

}  // namespace ph::app
