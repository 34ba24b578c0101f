// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/detail/facade/choose_engine.hpp"

namespace ph::detail {

/// The highest dimension to compute. @throws Error (usage) as check, or above 0 where only the
/// components are there.
int rips_max_dim(const Rips& rips, const Options& options);

/// Whether the edges of a Rips complex are collapsed, why, and the engine that then runs.
struct CollapseChoice {
  bool collapses;
  std::string reason;
  Engine engine;
  std::string_view engine_reason;
};
/// @throws Error (usage) if a collapse is asked for that would spoil the result, or as
/// choose_engine.
CollapseChoice choose_collapse(const Rips& rips, const Options& options, const RunContext& context);

}  // namespace ph::detail
