// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/error.hpp"

namespace ph::app {

/// The option for a setting, without its dashes, such as "max-dim".
std::string option_name(Setting setting);

/// Writes settings as options, such as "--nan drop". A setting for which the program has no option
/// has no words.
extern const Words kWords;

/// States the options of the program, by long names with dashes. Until then, each setting counts as
/// an option.
void set_known_options(std::vector<std::string> names);

}  // namespace ph::app
