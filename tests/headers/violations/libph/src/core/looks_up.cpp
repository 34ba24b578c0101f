// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/input.hpp"
#include "ph/rips.hpp"

std::string text(const std::vector<int>& numbers) { return fmt::format("{}", fmt::join(numbers, " ")); }
