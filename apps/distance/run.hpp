// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"
#include "apps/distance/arguments/arguments.hpp"

namespace ph::distance_program {

inline constexpr app::Program kProgram{"ph-distance",
                                       "use fewer barcodes or bars, or raise --memory-limit"};

/// Runs ph-distance after its command line was parsed. @return the exit code. @throws Error.
int run(const Arguments& arguments, app::Session& session);

}  // namespace ph::distance_program
