// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace ph::app {

// There is only one standard error, regardless of the objects that a program has. Messages and the
// status line are written to it through these functions, one at a time. Any later output erases a
// status line.

/// Writes one line to stderr in one piece, made safe for a terminal. Control characters and bytes
/// that are not UTF-8 are escaped. Errors are ignored, because there is nowhere to report them.
void print_line(std::string_view line);

/// Writes the line `prefix: text` unchanged. Allocates no memory.
void print_without_memory(std::string_view prefix, std::string_view text);

/// Shows a text on the last line of a terminal, in place of the previous text. It stays until
/// something else is written.
void show_status(std::string_view text);
/// Erases the status line.
void wipe_status();

}  // namespace ph::app
