// SPDX-License-Identifier: MIT
#pragma once
#include <tuple>

#include "ph/engine/arrows.hpp"
#include "ph/engine/cohomology.hpp"
#include "ph/engine/lens.hpp"
#include "ph/engine/standard.hpp"
#include "ph/engine/twist.hpp"
#include "ph/engine/union_find.hpp"

namespace ph {

/// All engines: a new one is a file and a line here (and its name in `Engine`). Names on the
/// command line, the conformance suite and the benchmarks iterate over this list.
using Engines = std::tuple<StandardEngine, TwistEngine, CohomologyEngine, UnionFindEngine,
                           LensEngine, ArrowsEngine>;

/// Calls `use(engine)` for each registered engine.
template <class Use>
void for_each_engine(Use&& use) {
  std::apply([&](auto... engine) { (use(engine), ...); }, Engines{});
}

}  // namespace ph
