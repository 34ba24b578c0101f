// SPDX-License-Identifier: MIT
#pragma once
#include <tuple>

#include "ph/detail/cohomology.hpp"
#include "ph/detail/standard.hpp"
#include "ph/detail/twist.hpp"
#include "ph/detail/union_find.hpp"

namespace ph {

/// The engines for any filtration. Those of one kind of complex beside them: all_engines.hpp.
using GenericEngines = std::tuple<StandardEngine, TwistEngine, CohomologyEngine, UnionFindEngine>;

/// Calls `use(engine)` for each engine of a list.
template <class Engines, class Use>
void for_each_engine_of(Use&& use) {
  std::apply([&](auto... engine) { (use(engine), ...); }, Engines{});
}

}  // namespace ph
