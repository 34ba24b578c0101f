// SPDX-License-Identifier: MIT
#pragma once
#include "ph/alpha.hpp"
#include "ph/detail/facade/engine_list.hpp"

namespace ph::detail {

// All engines for any filtration, and the engine of alpha complexes.
template <>
std::vector<EngineFor<Alpha>>& engines<Alpha>();

}  // namespace ph::detail
