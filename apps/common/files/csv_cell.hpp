// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// A name as a cell of CSV. If the name has a character with a meaning in CSV, it is put in quotes,
/// and quotes inside it are doubled.
std::string csv_cell(const std::string& name);

}  // namespace ph::app
