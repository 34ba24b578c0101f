// SPDX-License-Identifier: MIT
// This file computes results of a recipe: its barcode, an estimate, and the collapsed edges.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ph/detail/core/format_size.hpp"
#include "ph/detail/facade/adjust.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/estimate.hpp"
#include "ph/loops.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/calls/words.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/recipes.hpp"

namespace ph::python {
namespace {

Bars compute(const Recipe& recipe, const Task& task, const RunContext& context) {
  const Built built = recipe.build(context);
  const RunPlan planned = plan(built.complex, task.options, context);

  Bars bars{run(built.complex, planned, context)};
  if (task.loops != LoopChoice::none)
    bars.loops = loops(built.complex, bars.barcode, planned.options,
                       task.loops == LoopChoice::tight, context);
  const auto* alpha = std::get_if<Alpha>(&built.complex);
  // In a periodic space, a mean of coordinates is no place.
  if (const auto points = recipe.points();
      points && task.options.representatives == Representatives::cycles &&
      !(alpha && alpha->is_periodic()))
    bars.centroids = centroids(bars.barcode, *points, context);
  if (!recipe.vertex_ids().empty()) {
    bars.barcode = with_input_ids(bars.barcode, recipe.vertex_ids());
    name_points(bars.loops, recipe.vertex_ids());
  }
  if (task.options.max_dim) bars.set_max_dim(*task.options.max_dim);
  bars.field = task.options.field;
  return bars;
}

Bars barcode(const Recipe& recipe, const Task& task, const RunOptions& options) {
  return run(options, recipe.is_short(task.options),
             [&](const RunContext& context) { return compute(recipe, task, context); });
}

/// The barcode of each recipe. Task i belongs to recipe i.
std::vector<Bars> barcodes(const std::vector<const Recipe*>& recipes,
                           const std::vector<Task>& tasks, const RunOptions& options) {
  const bool is_short = recipes.size() == 1 && recipes[0]->is_short(tasks[0].options);
  return run(options, is_short, [&](const RunContext& context) {
    std::vector<Bars> all(recipes.size());
    std::vector<std::optional<MemoryClaim>> held(recipes.size());  // the barcodes that are done
    for_each_input(recipes.size(), context, [&](std::size_t i, const RunContext& of_input) {
      all[i] = compute(*recipes[i], tasks[i], of_input);
      held[i].emplace(context.memory, all[i].barcode.bytes());
    });
    return all;
  });
}

Estimate estimate_of(const Recipe& recipe, const Task& task, const RunOptions& options) {
  return run(options, recipe.is_short(task.options), [&](const RunContext& context) {
    const Built built = recipe.build(context);
    return estimate(built.complex, task.options, context);
  });
}

/// One way to make a computation fit into its memory limit. It consists of keywords to change
/// together, and a text that names them with the memory that the computation then takes.
using WayOut = std::pair<std::vector<std::pair<std::string, std::string>>, std::string>;

std::vector<WayOut> ways_to_fit(const Recipe& recipe, const Task& task, const RunOptions& options) {
  const std::vector<Fit> fits = run(options, false, [&](const RunContext& context) {
    return what_fits(recipe.build(context).complex, task.options, context);
  });
  std::vector<WayOut> ways;
  for (const Fit& fit : fits) {
    WayOut& way = ways.emplace_back();
    for (const auto& [setting, value] : fit.changes) {
      const Keyword keyword = keyword_of(setting, value);
      way.first.emplace_back(keyword.name, keyword.value);
      way.second += (way.second.empty() ? "" : ", ") + kWords.setting(setting, value);
    }
    way.second +=
        fmt::format(" ({} to {})", format_size(fit.bytes_low), format_size(fit.bytes_high));
  }
  return ways;
}

/// The remaining edges, as arrays of their larger ends, their smaller ends and their values.
py::tuple collapsed_edges(const RipsRecipe& recipe, const RunOptions& options) {
  struct Edges {
    std::vector<std::int64_t> u, v;
    std::vector<double> values;
  };
  Edges edges = run(options, false, [&](const RunContext& context) {
    const RipsGraph graph = recipe.collapsed(context);
    Edges all;
    for (const FlagEdge& edge : graph.edges()) {
      all.u.push_back(edge.u);
      all.v.push_back(edge.v);
      all.values.push_back(edge.value);
    }
    return all;
  });
  return py::make_tuple(Block::of(std::move(edges.u)), Block::of(std::move(edges.v)),
                        Block::of(std::move(edges.values)));
}

/// @throws Error (usage) if no engine has this name.
Engine engine_of(const std::string& name) {
  if (const std::optional<Engine> engine = engine_named(name)) return *engine;
  throw Error(ErrorKind::usage, "engine: found '" + name + "', expected one of engine_names()");
}

}  // namespace

void bind_computations(py::module_& m) {
  py::class_<Task>(m, "Task").def(
      py::init([](std::optional<int> max_dim, int min_dim, std::int64_t field,
                  const std::string& engine, Collapse collapse, double min_persistence,
                  Representatives representatives, bool cells, LoopChoice loops) {
        Task task;
        task.options = {max_dim,  min_dim,         field,           engine_of(engine),
                        collapse, min_persistence, representatives, cells};
        task.loops = loops;
        return task;
      }),
      py::arg("max_dim"), py::arg("min_dim"), py::arg("field"), py::arg("engine"),
      py::arg("collapse"), py::arg("min_persistence"), py::arg("representatives"), py::arg("cells"),
      py::arg("loops"));
  py::class_<Estimate>(m, "Estimate")
      .def_property_readonly("engine",
                             [](const Estimate& e) { return std::string(e.options.engine.name()); })
      .def_readonly("reason", &Estimate::reason)
      .def_property_readonly("collapses",
                             [](const Estimate& e) { return e.options.collapse == Collapse::on; })
      .def_readonly("collapse_reason", &Estimate::collapse_reason)
      .def_property_readonly("max_dim", [](const Estimate& e) { return *e.options.max_dim; })
      .def_readonly("cells", &Estimate::cells)
      .def_readonly("counted_dims", &Estimate::counted_dims)
      .def_readonly("bytes_low", &Estimate::bytes_low)
      .def_readonly("bytes_high", &Estimate::bytes_high);
  m.def("engine_names", [] {
    const auto names = engine_names();
    return std::vector<std::string>(names.begin(), names.end());
  });
  m.def("engine_named", [](const std::string& name) {
    const auto engine = engine_named(name);
    return engine ? std::optional(std::string(engine->name())) : std::nullopt;
  });
  m.def("barcode", &barcode, py::arg("recipe"), py::arg("task"), py::arg("run"));
  m.def("barcodes", &barcodes, py::arg("recipes"), py::arg("tasks"), py::arg("run"));
  m.def("estimate", &estimate_of, py::arg("recipe"), py::arg("task"), py::arg("run"));
  m.def("ways_to_fit", &ways_to_fit, py::arg("recipe"), py::arg("task"), py::arg("run"));
  m.def("collapsed_edges", &collapsed_edges, py::arg("recipe"), py::arg("run"));
}

}  // namespace ph::python
