// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "segment/arguments/arguments.hpp"

namespace ph::segment {

/// The options that do nothing beside the others, a line each: what is asked for has no use for
/// them. Those that do nothing for an input or a method are refused, see option_scopes.hpp.
std::vector<std::string> idle_options(const Arguments& arguments);

}  // namespace ph::segment
