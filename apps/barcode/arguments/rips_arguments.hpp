// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// Registers the options that only Rips complexes have: collapse, samples, approximation, weights.
/// `arguments` must outlive `app`.
void add_rips_options(CLI::App& app, Arguments& arguments);

/// What no single one of them can see: weights come from one place, and exclude what makes sense
/// for plain distances only. Sets what follows from them. @throws Error (usage).
void check_rips_arguments(Arguments& arguments);

}  // namespace ph::barcode
