// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// Registers the options that only alpha complexes have. `arguments` must outlive `app`.
void add_alpha_options(CLI::App& app, Arguments& arguments);

/// What no single one of them can see. Sets what follows from them. @throws Error (usage).
void check_alpha_arguments(Arguments& arguments);

}  // namespace ph::barcode
