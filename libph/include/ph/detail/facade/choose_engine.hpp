// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "ph/detail/facade/describe.hpp"
#include "ph/detail/facade/engine_list.hpp"
#include "ph/error.hpp"

namespace ph::detail {

/// @throws Error (usage) on dimensions below 0, on a min_persistence that is NaN, and on an invalid
///         field.
void check(const Options& options);
/// Checks the options for a complex that allows no edge collapse.
/// @throws Error (usage) as check, and also on an edge collapse or a field that needs incidence
/// numbers.
void check_as_it_is(const Options& options, bool has_incidences);

/// The engine that will run, and the reason.
template <Filtration F>
struct EngineChoice {
  const EngineFor<F>* engine = nullptr;
  std::string_view reason;
};

/// @throws Error (usage): the requested engine cannot do the task, or no engine can.
[[noreturn]] void refuse(Engine asked, const Task& task);

/// The requested engine, or the engine that suits the task best.
/// @throws Error (usage) if the requested engine cannot do the task.
template <Filtration F>
EngineChoice<F> choose_engine(const F& f, Engine asked, const Task& task) {
  EngineChoice<F> choice;
  int rank = 0;
  for (const EngineFor<F>& engine : engines<F>()) {
    if (asked != Engine::automatic && engine.id != asked) continue;
    if (!engine.can_run(f, task)) continue;
    const Suitability suits =
        asked == Engine::automatic ? engine.suitability(f, task) : Suitability{1, "requested"};
    if (suits.rank <= rank) continue;
    rank = suits.rank;
    choice = {&engine, suits.reason};
  }
  if (rank == 0) refuse(asked, task);
  return choice;
}

inline Task task_of(const Options& options, int max_dim) {
  return {max_dim, options.representatives, options.min_persistence < 0,
          options.collapse == Collapse::on};
}

/// The highest dimension that will be computed, and the engine.
template <Filtration F>
struct Plan {
  int max_dim;
  EngineChoice<F> choice;
};
/// @throws Error (usage) as check_as_it_is and choose_engine.
template <Filtration F>
Plan<F> plan_for(const F& f, const Options& options) {
  bool has_incidences = true;
  if constexpr (requires { f.has_incidences(); }) has_incidences = f.has_incidences();
  check_as_it_is(options, has_incidences);
  // Low dimensions are tried before the top dimension is determined, because determining it takes
  // time and memory for a flag complex.
  if (options.max_dim && *options.max_dim <= 3) {
    const EngineChoice<F> choice =
        choose_engine(f, options.engine, task_of(options, *options.max_dim));
    if (choice.engine->goes_by_edges) return {*options.max_dim, choice};
  }
  const int top = std::max(0, f.top_dim());
  const int max_dim = std::min(options.max_dim.value_or(top), top);
  return {max_dim, choose_engine(f, options.engine, task_of(options, max_dim))};
}

/// The plan with these decisions, without an edge collapse.
inline RunPlan run_plan(Options options, int max_dim, Engine engine, std::string_view reason) {
  options.max_dim = max_dim;
  options.engine = engine;
  options.collapse = Collapse::off;
  return {std::move(options), std::nullopt, std::string(reason), {}};
}

/// The barcode without its origin, computed as planned and without an edge collapse.
template <Filtration F>
Barcode bars_of(const F& filtration, const Plan<F>& plan, const Options& options,
                const RunContext& context) {
  BarcodeBuilder<F> bars(filtration, plan.max_dim, options.min_persistence, options.representatives,
                         options.cells, context);
  bars.set_min_dim(options.min_dim);
  plan.choice.engine->run(filtration, options.field, bars, context);
  return bars.finish();
}

/// The barcode with its origin, computed by one of the engines of the filtration without an edge
/// collapse.
template <Filtration F>
Barcode compute(const F& filtration, const Options& options, const RunContext& context) {
  const Plan<F> plan = plan_for(filtration, options);
  Barcode bars = bars_of(filtration, plan, options, context);
  BarcodeInfo info = info_of_task(options, plan.max_dim, plan.choice.engine->id);
  describe(filtration, info);
  bars.set_info(std::move(info));
  return bars;
}

}  // namespace ph::detail
