// SPDX-License-Identifier: MIT
#pragma once
#include <stop_token>

#include "common/run/program.hpp"

namespace ph::vectorise {

inline constexpr app::Program kProgram{
    "ph-vectorise",
    "take fewer inputs, a coarser --grid or fewer --layers, or raise --memory-limit"};

/// The whole program. @return its exit code. @throws Error.
int run(int argc, const char* const* argv, std::stop_token stop);

}  // namespace ph::vectorise
