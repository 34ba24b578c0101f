// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"
#include "common/run/session.hpp"

namespace ph::barcode {

/// The format that --output-format or the name of the output selects. @throws Error (usage) on a
/// picture.
BarcodeFormat output_format(const Arguments& arguments, app::Session& session);

/// Runs all inputs. With an output folder, one failure does not stop the others: its line goes to
/// stderr, and the code of the first failure is returned at the end.
int run_all(const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
