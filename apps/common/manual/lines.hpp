// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// Splits a text into words at its blanks.
std::vector<std::string_view> words_of(std::string_view text);

/// Breaks a text at its blanks into lines of at most this many characters, unless a word is longer.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns);

/// Does the same for a list of alternatives, a|b|c, which is broken after `|`.
std::vector<std::string> wrapped_list(std::string_view text, std::size_t columns);

/// The number of terminal columns that a UTF-8 text takes. The text must not contain wide
/// characters.
std::size_t columns_of(std::string_view text);

/// The text with a backslash before each of these characters.
std::string with_backslashes(std::string_view text, std::string_view characters);

/// The text in single quotes, as POSIX shells and zsh read it.
std::string shell_quoted(std::string_view text);

}  // namespace ph::app
