// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "segment/arguments/arguments.hpp"

namespace ph::segment {

/// What a user should know before trusting the result, a line each: what the check found, no plane,
/// units or a camera that cannot be meant.
/// @param cloud none: a stored tree was cut.
std::vector<std::string> warnings(const Arguments& arguments, const std::optional<Cloud>& cloud,
                                  const Segmentation& segmentation);

}  // namespace ph::segment
