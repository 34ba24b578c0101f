// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/error.hpp"

namespace ph::app {

/// The option for a setting, without its dashes, such as "max-dim".
std::string option_name(Setting setting);

/// Writes settings as options, such as "--nan drop".
extern const Words kWords;

}  // namespace ph::app
