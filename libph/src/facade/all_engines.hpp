// SPDX-License-Identifier: MIT
#pragma once
#include <tuple>

#include "cubical/gradient.hpp"
#include "ph/detail/facade/choose_engine.hpp"
#include "ph/detail/facade/generic_engines.hpp"
#include "rips/beta_skeleton/beta_skeleton.hpp"
#include "rips/edge_links.hpp"

namespace ph::detail {

/// All engines of libph. To add an engine, write its file and put it into this list.
using AllEngines = decltype(std::tuple_cat(
    GenericEngines{}, std::tuple<EdgeLinkEngine, BetaSkeletonEngine, GradientEngine>{}));

template <Filtration F>
std::vector<EngineFor<F>> all_engines() {
  return engines_of_list<F>(static_cast<AllEngines*>(nullptr));
}

}  // namespace ph::detail
