// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// A name as a cell of CSV. If the name is empty or contains a character that has a meaning in CSV,
/// the name is enclosed in quotes, and quotes inside it are doubled.
std::string csv_cell(const std::string& name);

}  // namespace ph::app
