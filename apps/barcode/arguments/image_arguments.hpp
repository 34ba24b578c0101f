// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// Registers the options that images and cubical complexes have. `arguments` must outlive `app`.
void add_cubical_options(CLI::App& app, Arguments& arguments);
/// Registers how an image lies in a file without a header.
void add_raw_options(CLI::App& app, Arguments& arguments);

/// What no single one of them can see. Sets what follows from them. @throws Error (usage).
void check_image_arguments(Arguments& arguments);

}  // namespace ph::barcode
