// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/complex/cubical_cells.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/persistence.hpp"

namespace ph::detail {

/// An engine made for one type of filtration.
template <Filtration F>
struct EngineFor : EngineFacts {
  bool (*can_run)(const F&, const Task&) = nullptr;
  Suitability (*suitability)(const F&, const Task&) = nullptr;
  void (*run)(const F&, std::int64_t field, BarcodeBuilder<F>&, const RunContext&) = nullptr;
};

/// The engines for one type of filtration: names on the command line, the choice of an engine, the
/// conformance suite and the benchmarks all use this list. A type of your own has the engines of
/// generic_engines.hpp.
template <Filtration F>
std::vector<EngineFor<F>>& engines();

// The library contains all engines for the complexes of libph, compiled once. Compiling every
// engine for every field takes a long time.
#define PH_WITH_ALL_ENGINES(...) \
  template <>                    \
  std::vector<EngineFor<__VA_ARGS__>>& engines<__VA_ARGS__>()
PH_WITH_ALL_ENGINES(Cubical);
PH_WITH_ALL_ENGINES(ExplicitComplex);
PH_WITH_ALL_ENGINES(FilteredGraph);
PH_WITH_ALL_ENGINES(RipsFiltration<RipsLayout::dense, 1>);
PH_WITH_ALL_ENGINES(RipsFiltration<RipsLayout::sparse, 1>);
PH_WITH_ALL_ENGINES(RipsFiltration<RipsLayout::any, 4>);
#undef PH_WITH_ALL_ENGINES

/// The facts of all engines, in the order of their names in --help.
std::vector<EngineFacts>& engine_facts();

}  // namespace ph::detail
