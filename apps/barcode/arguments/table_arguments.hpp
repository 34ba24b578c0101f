// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// What of a table or a picture is read: --columns, --channel.
void add_table_options(CLI::App& app, Arguments& a);

/// Decides what a table means where other options leave one reading only.
void check_table_arguments(Arguments& a);

}  // namespace ph::barcode
