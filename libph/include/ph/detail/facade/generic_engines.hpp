// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <tuple>
#include <vector>

#include "ph/detail/components/union_find.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/on_first_use.hpp"
#include "ph/detail/facade/engine_list.hpp"
#include "ph/detail/reduction/cohomology.hpp"
#include "ph/detail/reduction/standard.hpp"
#include "ph/detail/reduction/twist.hpp"

namespace ph::detail {

/// The facts of an engine. @tparam E an engine as ph/custom.hpp describes it.
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
  if constexpr (requires { E::rips_forms; }) facts.rips_forms = E::rips_forms;
  if constexpr (requires(const RipsInput& input, const Task& task) { E::obstacle(input, task); })
    facts.rips_obstacle = [](const RipsInput& input, const Task& task) {
      return E::obstacle(input, task);
    };
  if constexpr (requires(const RipsInput& input, const Task& task) { E::suitability(input, task); })
    facts.rips_suitability = [](const RipsInput& input, const Task& task) {
      return E::suitability(input, task);
    };
  return facts;
}

/// True if the engine can do the task. A filtration that holds only points has no cells, which
/// rules out engines that do not accept points.
template <class E, Filtration F>
bool can_run(const F& f, const Task& task) {
  if constexpr (requires { f.points_alone(); }) {
    constexpr bool takes_points = [] {
      if constexpr (requires { E::rips_forms; })
        return std::ranges::find(E::rips_forms, RipsForm::points) != E::rips_forms.end();
      else
        return false;
    }();
    if (!takes_points && f.points_alone() != nullptr) return false;
  }
  return E::can_run(f, task);
}

template <class E, Filtration F>
constexpr EngineFor<F> engine_for() {
  return {facts<E>(), [](const F& f, const Task& task) { return can_run<E>(f, task); },
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

/// The engines for any filtration. all_engines.hpp adds the engines for one kind of complex.
using GenericEngines = std::tuple<StandardEngine, TwistEngine, CohomologyEngine, UnionFindEngine>;

template <Filtration F>
std::vector<EngineFor<F>>& engines() {
  static constinit OnFirstUse list(
      [] { return engines_of_list<F>(static_cast<GenericEngines*>(nullptr)); });
  return *list;
}

}  // namespace ph::detail
