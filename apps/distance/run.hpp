// SPDX-License-Identifier: MIT
#pragma once
#include <stop_token>

#include "common/run/program.hpp"

namespace ph::distance_program {

inline constexpr app::Program kProgram{"ph-distance",
                                       "take fewer barcodes or bars, or raise --memory-limit"};

/// The whole program. @return its exit code. @throws Error.
int run(int argc, const char* const* argv, std::stop_token stop);

}  // namespace ph::distance_program
