// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"
#include "apps/vectorise/arguments/arguments.hpp"

namespace ph::vectorise {

inline constexpr app::Program kProgram{
    "ph-vectorise",
    "use fewer inputs, a coarser --grid or fewer --layers, or raise --memory-limit"};

/// Runs ph-vectorise after its command line was parsed. @return the exit code. @throws Error.
int run(const Arguments& arguments, app::Session& session);

}  // namespace ph::vectorise
