// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace ph::app {

// There is one standard error, whatever objects a program has: messages and the status go there
// through these functions, one at a time, and a status is wiped away by what comes after it.

/// Writes one line to stderr in one piece, made safe for a terminal: control characters and bytes
/// that are not UTF-8 are escaped. Errors are ignored: there is nowhere to report them.
void print_line(std::string_view line);

/// Writes the line `prefix: text` as it is. Allocates nothing.
void print_without_memory(std::string_view prefix, std::string_view text);

/// Shows a text on the last line of a terminal, in place of the one before; it stays until
/// something else is written.
void show_status(std::string_view text);
/// Wipes it.
void wipe_status();

}  // namespace ph::app
