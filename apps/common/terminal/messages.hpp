// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace ph::app {

// There is one standard error, whatever objects a program has. Messages and the status line go
// there through these functions, one at a time, and any later output erases a status line.

/// Writes one line to stderr in one piece, made safe for a terminal: control characters and bytes
/// that are not UTF-8 are escaped. Errors are ignored, because there is nowhere to report them.
void print_line(std::string_view line);

/// Writes the line `prefix: text` unchanged. Allocates nothing.
void print_without_memory(std::string_view prefix, std::string_view text);

/// Shows a text on the last line of a terminal, in place of the previous one; it stays until
/// something else is written.
void show_status(std::string_view text);
/// Erases the status line.
void wipe_status();

}  // namespace ph::app
