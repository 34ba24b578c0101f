// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// The inputs, with each folder replaced by its files.
/// @throws Error (no_input) if a folder has no file of a known format.
std::vector<std::string> with_files_of_folders(const Arguments& arguments);

}  // namespace ph::barcode
