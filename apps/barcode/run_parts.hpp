// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/run.hpp"

namespace ph::barcode {

/// Computes the part that the arguments name. Precondition: arguments.part. @return the exit code.
/// @throws Error.
int run_part(const Arguments& arguments, app::Session& session);

/// Joins the inputs, which are parts. @return the exit code. @throws Error.
int run_join(const Arguments& arguments, BarcodeFormat format, app::Session& session);

}  // namespace ph::barcode
