// SPDX-License-Identifier: MIT
#pragma once
#include <stop_token>

#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// Is one of the processes that compute an image, or the components of points, together, and talk
/// through the folder of --exchange. Part 1 writes. Precondition: arguments.part.
/// @return the exit code. @throws Error.
int run_exchange(Arguments arguments, const std::stop_token& stop);

}  // namespace ph::barcode
