// SPDX-License-Identifier: MIT
#pragma once
#include <tuple>
#include <vector>

#include "ph/detail/components/union_find.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/reduction/cohomology.hpp"
#include "ph/detail/reduction/standard.hpp"
#include "ph/detail/reduction/twist.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/engine.hpp"
#include "ph/persistence.hpp"

namespace ph::detail {

/// Calls `use(field)` with the field of the given characteristic. @throws Error (usage) if none.
template <class Use>
decltype(auto) with_field(std::int64_t characteristic, Use&& use) {
  if (characteristic == 2) return use(Z2{});
  return use(Zp(characteristic));
}

/// An engine made for one type of filtration.
template <Filtration F>
struct EngineFor : EngineFacts {
  bool (*can_run)(const F&, const Task&) = nullptr;
  Suitability (*suitability)(const F&, const Task&) = nullptr;
  void (*run)(const F&, std::int64_t field, BarcodeBuilder<F>&, const RunContext&) = nullptr;
};

/// @tparam E what ph/custom.hpp calls an engine.
template <class E>
constexpr EngineFacts facts() {
  EngineFacts facts{.id = E::id, .listed_dim = [](int max_dim) { return E::listed_dim(max_dim); }};
  if constexpr (requires { E::goes_by_edges; }) facts.goes_by_edges = E::goes_by_edges;
  if constexpr (requires { E::is_oracle; }) facts.is_oracle = E::is_oracle;
  if constexpr (requires { E::stops_early; }) facts.stops_early = E::stops_early;
  if constexpr (requires { E::rips_bytes(std::size_t(), std::size_t()); })
    facts.rips_bytes = [](std::size_t vertices, std::size_t edges) {
      return E::rips_bytes(vertices, edges);
    };
  return facts;
}

template <class E, Filtration F>
constexpr EngineFor<F> engine_for() {
  return {facts<E>(), [](const F& f, const Task& task) { return E::can_run(f, task); },
          [](const F& f, const Task& task) { return E::suitability(f, task); },
          [](const F& f, std::int64_t characteristic, BarcodeBuilder<F>& bars,
             const RunContext& context) {
            with_field(characteristic, [&](const auto& field) { E::run(f, field, bars, context); });
          }};
}

template <Filtration F, class... E>
std::vector<EngineFor<F>> engines_of_list(std::tuple<E...>*) {
  return {engine_for<E, F>()...};
}

/// The engines for any filtration. Those of one kind of complex beside them: all_engines.hpp.
using GenericEngines = std::tuple<StandardEngine, TwistEngine, CohomologyEngine, UnionFindEngine>;

/// The engines for one type of filtration: names on the command line, the choice of an engine, the
/// conformance suite and the benchmarks go through this list.
template <Filtration F>
std::vector<EngineFor<F>>& engines() {
  static auto list = engines_of_list<F>(static_cast<GenericEngines*>(nullptr));
  return list;
}

// Those of libph have all engines, compiled once: engines times fields are costly to instantiate.
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

/// What all engines say about themselves, in the order of their names in --help.
std::vector<EngineFacts>& engine_facts();

}  // namespace ph::detail
