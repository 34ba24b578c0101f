// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/euler_curve.hpp"
#include "vectorise/arguments/arguments.hpp"
#include "vectorise/fit/fit.hpp"

namespace ph::vectorise {

/// What the arguments say, without blocks.
Fit fit_of(const Arguments& arguments);

/// Adds a block for each dimension, with what is fitted to all barcodes. @param names of inputs.
/// @param dropped receives how many bars were left out. @throws Error as the functions that fit.
void add_blocks(Fit& fit, const std::vector<Barcode>& barcodes,
                const std::vector<std::string>& names, const Arguments& arguments,
                std::size_t& dropped, const RunContext& context);

/// Adds the block of Euler curves. @param curves those that the grid is fitted to; none if it is
/// given.
void add_euler_block(Fit& fit, std::span<const StepFunction> curves, const Arguments& arguments);

}  // namespace ph::vectorise
