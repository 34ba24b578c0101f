// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ph::app {

/// What to type instead of an option that a program does not have, if other programs or packages
/// have it; otherwise empty. `known` are the options of the program. All names begin with two
/// dashes.
std::string hint_for_foreign_option(std::string_view typed,
                                    std::span<const std::string_view> known);

}  // namespace ph::app
