// SPDX-License-Identifier: MIT
#pragma once
// For a complex of your own: the engines as templates, and how `persistence` chooses among them.
// Costly to compile; whoever uses the complexes of libph needs persistence.hpp only.
#include <algorithm>
#include <string>

#include "ph/engine/registry.hpp"
#include "ph/persistence.hpp"

namespace ph {
namespace detail {

/// @throws Error (usage) on dimensions below 0 or a min_persistence that is no number.
void check(const Options& options);

/// The highest dimension to compute. @throws Error (usage) as check, or above 0 where
/// only the components are there.
int rips_max_dim(const Rips& rips, const Options& options);

/// The engine that will run, with the reason.
struct EngineChoice {
  Engine engine;
  std::string_view reason;
};

/// @throws Error (usage) if the engine asked for cannot do it.
template <Filtration F>
EngineChoice choose_engine(const F& f, Engine asked, const Task& task) {
  if (asked == Engine::automatic) {
    if (ArrowsEngine::can_run(f, task))
      return {Engine::arrows, "an image is paired voxel by voxel"};
    if (UnionFindEngine::can_run(f, task))
      return {Engine::union_find, "only components are asked for"};
    if (LensEngine::can_run(f, task))
      return {Engine::lens, "H1 and H2 of a Rips complex need no triangles"};
    // Measured: where cells are numbered, columns are few and short in both directions and the
    // boundary wins; where they are not, the next dimension must never be listed.
    if (SlottedFiltration<F> && TwistEngine::can_run(f, task))
      return {Engine::twist, "the complex numbers its cells"};
    if (CohomologyEngine::can_run(f, task))
      return {Engine::cohomology, "cells of the highest dimension are too many to list"};
    if (TwistEngine::can_run(f, task)) return {Engine::twist, "the complex lists facets only"};
    if (!task.wants_no_sets())
      throw Error(ErrorKind::usage,
                  "sets of voxels need an image of at most three axes that have more than one "
                  "voxel, and bars of positive length");
    throw Error(ErrorKind::usage, "cocycles need a complex that lists cofacets");
  }
  bool can_run = false;
  for_each_engine([&](auto engine) {
    if (engine.id == asked) can_run = engine.can_run(f, task);
  });
  if (!can_run) {
    const Representatives wanted = task.representatives;
    throw Error(ErrorKind::usage, "engine " + std::string(engine_name(asked)) +
                                      " cannot compute homology up to dimension " +
                                      std::to_string(task.max_dim) + " of this complex" +
                                      (wanted == Representatives::none     ? ""
                                       : wanted == Representatives::cycles ? " with cycles"
                                       : wanted == Representatives::voxels ? " with sets of voxels"
                                                                           : " with cocycles") +
                                      (task.zero_length ? ", zero-length bars included" : ""));
  }
  return {asked, "asked for"};
}

/// Whether the edges of a Rips complex are collapsed, why, and the engine that then runs.
struct CollapseChoice {
  bool collapses;
  std::string reason;
  EngineChoice engine;
};
/// @throws Error (usage) if a collapse is asked for that would spoil the result, or as
/// choose_engine.
CollapseChoice choose_collapse(const Rips& rips, const Options& options, const RunContext& context);

inline Task task_of(const Options& options, int max_dim) {
  return {max_dim, options.representatives, options.min_persistence < 0};
}

/// What will be computed: up to which dimension, by which engine.
struct Plan {
  int max_dim;
  EngineChoice choice;
};
/// @throws Error (usage) as check and choose_engine.
template <Filtration F>
Plan plan(const F& f, const Options& options) {
  check(options);
  // Low dimensions first: the top dimension of a flag complex takes time and memory to find.
  if (options.max_dim && *options.max_dim <= 2) {
    const EngineChoice choice =
        choose_engine(f, options.engine, task_of(options, *options.max_dim));
    if (choice.engine == Engine::lens || choice.engine == Engine::union_find)
      return {*options.max_dim, choice};
  }
  const int top = std::max(0, f.top_dim());
  const int max_dim = std::min(options.max_dim.value_or(top), top);
  return {max_dim, choose_engine(f, options.engine, task_of(options, max_dim))};
}

/// Calls `use(field)` with the field of the given characteristic. @throws Error (usage) if none.
template <class Use>
decltype(auto) with_field(std::int64_t characteristic, Use&& use) {
  if (characteristic == 2) return use(Z2{});
  return use(Zp(characteristic));
}

}  // namespace detail

/// The barcode of a complex of your own: anything that models Filtration. @throws as the others.
template <Filtration F>
Barcode persistence(const F& filtration, const Options& options = {},
                    const RunContext& context = default_context()) {
  if (options.collapse == Collapse::on)
    throw Error(ErrorKind::usage, "edge collapse is for Rips complexes only");
  const auto [max_dim, choice] = detail::plan(filtration, options);
  const Engine chosen = choice.engine;
  BarcodeBuilder<F> bars(filtration, max_dim, options.min_persistence, options.representatives,
                         options.cells, context);
  bars.set_min_dim(options.min_dim);
  detail::with_field(options.field, [&](const auto& field) {
    for_each_engine([&](auto engine) {
      if (engine.id == chosen) engine.run(filtration, field, bars, context);
    });
  });
  return bars.finish();
}

// Compiled once, in libph/src/persistence/: engines times fields are costly to instantiate.
#define PH_INSTANTIATED(...)                                                           \
  extern template Barcode persistence<__VA_ARGS__>(const __VA_ARGS__&, const Options&, \
                                                   const RunContext&)
PH_INSTANTIATED(Cubical);
PH_INSTANTIATED(ExplicitComplex);
PH_INSTANTIATED(FilteredGraph);
PH_INSTANTIATED(RipsFiltration<RipsLayout::dense, 1>);
PH_INSTANTIATED(RipsFiltration<RipsLayout::sparse, 1>);
PH_INSTANTIATED(RipsFiltration<RipsLayout::any, 2>);
PH_INSTANTIATED(RipsFiltration<RipsLayout::any, 4>);
#undef PH_INSTANTIATED

}  // namespace ph
