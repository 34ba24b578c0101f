// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace ph::app {

/// Writes one line to stderr in one piece, made safe for a terminal: control characters and bytes
/// that are not UTF-8 are escaped. Errors are ignored: there is nowhere to report them.
void print_line(std::string_view line);

}  // namespace ph::app
