// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// Registers the options that say which complex is built. `arguments` must outlive `app`.
void add_complex_options(CLI::App& app, Arguments& arguments);
/// The same of what is computed of it: dimensions, field, engine, representatives.
void add_homology_options(CLI::App& app, Arguments& arguments);

}  // namespace ph::barcode
