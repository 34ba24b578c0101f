// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// A name as a cell of CSV: between quotes, which are doubled, if it has a mark that means
/// something.
std::string csv_cell(const std::string& name);

}  // namespace ph::app
