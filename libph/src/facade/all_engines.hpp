// SPDX-License-Identifier: MIT
#pragma once
#include <tuple>

#include "libph/src/cubical/gradient.hpp"
#include "libph/src/rips/beta_skeleton/beta_skeleton.hpp"
#include "libph/src/rips/edge_links.hpp"
#include "ph/detail/facade/choose_engine.hpp"
#include "ph/detail/facade/generic_engines.hpp"

namespace ph::detail {

/// All engines of libph except AlphaEngine, which has the name of GradientEngine and is only for
/// alpha complexes (see alpha.cpp). To add an engine, write its file and add the engine to this
/// list.
using AllEngines = decltype(std::tuple_cat(
    GenericEngines{}, std::tuple<EdgeLinkEngine, BetaSkeletonEngine, GradientEngine>{}));

template <Filtration F>
std::vector<EngineFor<F>> all_engines() {
  return engines_of_list<F>(static_cast<AllEngines*>(nullptr));
}

}  // namespace ph::detail
