// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::barcode {

/// What --formats prints: each format that is read or written, with what it is and a line of it.
std::string formats_table();

}  // namespace ph::barcode
