// SPDX-License-Identifier: MIT
#pragma once
#include "apps/cluster/arguments/arguments.hpp"
#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"

namespace ph::cluster {

inline constexpr app::Program kProgram{"ph-cluster", "use fewer points, or raise --memory-limit"};

/// Runs ph-cluster after its command line was parsed. @return the exit code. @throws Error.
int run(const Arguments& arguments, app::Session& session);

}  // namespace ph::cluster
