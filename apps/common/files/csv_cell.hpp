// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// A name as a cell of CSV: in quotes, with quotes inside doubled, if it has a character with a
/// meaning in CSV.
std::string csv_cell(const std::string& name);

}  // namespace ph::app
