// SPDX-License-Identifier: MIT
#pragma once
#include <tuple>

#include "cubical/arrows.hpp"
#include "ph/custom.hpp"
#include "rips/sweep/lens.hpp"

namespace ph {

/// Every engine there is. Names on the command line, the conformance suite and the benchmarks go
/// through this list.
using AllEngines =
    decltype(std::tuple_cat(GenericEngines{}, std::tuple<LensEngine, ArrowsEngine>{}));

template <class Use>
void for_each_engine(Use&& use) {
  for_each_engine_of<AllEngines>(use);
}

namespace detail {

// Compiled once, beside this file: engines times fields are costly to instantiate.
#define PH_COMPILED(...) \
  extern template Barcode compute<AllEngines>(const __VA_ARGS__&, const Options&, const RunContext&)
PH_COMPILED(Cubical);
PH_COMPILED(ExplicitComplex);
PH_COMPILED(FilteredGraph);
PH_COMPILED(RipsFiltration<RipsLayout::dense, 1>);
PH_COMPILED(RipsFiltration<RipsLayout::sparse, 1>);
PH_COMPILED(RipsFiltration<RipsLayout::any, 2>);
PH_COMPILED(RipsFiltration<RipsLayout::any, 4>);
#undef PH_COMPILED

}  // namespace detail

/// The barcode of a filtration of libph by any engine.
template <RipsLayout Layout, int Words>
Barcode persistence(const RipsFiltration<Layout, Words>& filtration, const Options& options = {},
                    const RunContext& context = default_context()) {
  return detail::compute<AllEngines>(filtration, options, context);
}

}  // namespace ph
