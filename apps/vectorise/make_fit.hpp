// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <vector>

#include "apps/vectorise/arguments/arguments.hpp"
#include "apps/vectorise/fit/fit.hpp"
#include "ph/barcode.hpp"
#include "ph/euler_curve.hpp"

namespace ph::vectorise {

/// The fit that the arguments describe, without blocks.
Fit fit_of(const Arguments& arguments);

/// Adds a block for each dimension, fitted to all barcodes. @param names the names of the inputs.
/// @param dropped receives the number of bars that were left out. @throws Error like the functions
///     that fit.
void add_blocks(Fit& fit, const std::vector<Barcode>& barcodes,
                const std::vector<std::string>& names, const Arguments& arguments,
                std::size_t& dropped, const RunContext& context);

/// Adds the block of Euler curves. @param curves the curves to which the grid is fitted; empty if
/// the grid is given.
void add_euler_block(Fit& fit, std::span<const StepFunction> curves, const Arguments& arguments);

}  // namespace ph::vectorise
