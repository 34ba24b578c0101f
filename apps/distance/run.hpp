// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"
#include "apps/distance/arguments/arguments.hpp"

namespace ph::distance_program {

inline constexpr app::Program kProgram{"ph-distance",
                                       "take fewer barcodes or bars, or raise --memory-limit"};

/// The whole program after parsing its command line. @return its exit code. @throws Error.
int run(const Arguments& arguments, app::Session& session);

}  // namespace ph::distance_program
