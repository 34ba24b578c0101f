// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/detail/generic_engines.hpp"
#include "ph/error.hpp"
#include "ph/persistence.hpp"

namespace ph::detail {

/// @throws Error (usage) on dimensions below 0 or a min_persistence that is no number.
void check(const Options& options);

/// The engine that will run, with the reason.
struct EngineChoice {
  Engine engine = Engine::automatic;
  std::string_view reason;
  bool goes_by_edges = false, is_oracle = false;  ///< as the engine says
};

/// @throws Error (usage): an engine cannot do a task, or none can.
[[noreturn]] void refuse(Engine asked, const Task& task);

/// The engine asked for, or the one that suits the task best.
/// @throws Error (usage) if the engine asked for cannot do it.
template <class Engines, Filtration F>
EngineChoice choose_engine(const F& f, Engine asked, const Task& task) {
  EngineChoice choice;
  int rank = 0;
  for_each_engine_of<Engines>([&](auto engine) {
    if (asked != Engine::automatic && engine.id != asked) return;
    if (!engine.can_run(f, task)) return;
    const Suitability suits =
        asked == Engine::automatic ? engine.suitability(f, task) : Suitability{1, "asked for"};
    if (suits.rank <= rank) return;
    rank = suits.rank;
    choice = {engine.id, suits.reason, engine.goes_by_edges, engine.is_oracle};
  });
  if (rank == 0) refuse(asked, task);
  return choice;
}

inline Task task_of(const Options& options, int max_dim) {
  return {max_dim, options.representatives, options.min_persistence < 0};
}

/// What will be computed: up to which dimension, by which engine.
struct Plan {
  int max_dim;
  EngineChoice choice;
};
/// @throws Error (usage) as check and choose_engine.
template <class Engines, Filtration F>
Plan plan(const F& f, const Options& options) {
  check(options);
  // Low dimensions first: the top dimension of a flag complex takes time and memory to find.
  if (options.max_dim && *options.max_dim <= 2) {
    const EngineChoice choice =
        choose_engine<Engines>(f, options.engine, task_of(options, *options.max_dim));
    if (choice.goes_by_edges) return {*options.max_dim, choice};
  }
  const int top = std::max(0, f.top_dim());
  const int max_dim = std::min(options.max_dim.value_or(top), top);
  return {max_dim, choose_engine<Engines>(f, options.engine, task_of(options, max_dim))};
}

/// Calls `use(field)` with the field of the given characteristic. @throws Error (usage) if none.
template <class Use>
decltype(auto) with_field(std::int64_t characteristic, Use&& use) {
  if (characteristic == 2) return use(Z2{});
  return use(Zp(characteristic));
}

/// The barcode by one of the engines of a list; edges are collapsed before, or not at all.
template <class Engines, Filtration F>
Barcode compute(const F& filtration, const Options& options, const RunContext& context) {
  if (options.collapse == Collapse::on)
    throw Error(ErrorKind::usage, "edge collapse is for Rips complexes only");
  const auto [max_dim, choice] = plan<Engines>(filtration, options);
  const Engine chosen = choice.engine;
  BarcodeBuilder<F> bars(filtration, max_dim, options.min_persistence, options.representatives,
                         options.cells, context);
  bars.set_min_dim(options.min_dim);
  with_field(options.field, [&](const auto& field) {
    for_each_engine_of<Engines>([&](auto engine) {
      if (engine.id == chosen) engine.run(filtration, field, bars, context);
    });
  });
  return bars.finish();
}

}  // namespace ph::detail
