// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/error.hpp"

namespace ph::app {

/// The option for a setting, without its dashes: "max-dim".
std::string option_name(Setting setting);

/// Settings as options: "--nan drop".
extern const Words kWords;

}  // namespace ph::app
