// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

namespace ph::app {

/// Text from outside (file names, words of an input) made safe for a terminal and for one line:
/// control characters and bytes that are not UTF-8 become \n, \t, \x1b …, long text is cut in its
/// middle.
std::string escaped(std::string_view text);

/// Writes one escaped line to stderr, whole. Errors are ignored: there is nowhere to report them.
void print_line(std::string_view line);

}  // namespace ph::app
