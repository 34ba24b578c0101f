// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// What --version --verbose says of any program: compiler, build, libraries; a line each.
std::string build_information();

}  // namespace ph::app
