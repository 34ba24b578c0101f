// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// Registers --part, --join and what goes with them. `arguments` must outlive `app`.
void add_part_options(CLI::App& app, Arguments& arguments);
/// What no single one of them can see. @throws Error (usage).
void check_part_arguments(const Arguments& arguments);

}  // namespace ph::barcode
