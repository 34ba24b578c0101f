// SPDX-License-Identifier: MIT
#include <cmath>

#include "libph/src/facade/rips_plan.hpp"
#include "ph/detail/facade/alpha_engines.hpp"
#include "ph/detail/facade/choose_engine.hpp"
#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/persistence.hpp"

namespace ph {
namespace {

/// The form of a Rips filtration. @throws Error (usage) if the plan is for another complex.
const RipsGraph& graph_of(const Rips& rips, const RunPlan& plan, const RunContext& context) {
  if (!plan.form)
    throw Error(ErrorKind::usage,
                "run: found a plan for a complex other than a Rips filtration, expected a plan for "
                "this Rips filtration");
  return rips.graph(*plan.form, context);
}

template <class Complex>
RunPlan plan_one(const Complex& complex, const Options& options, const RunContext&) {
  const auto plan = detail::plan_for(complex, options);
  return detail::run_plan(options, plan.max_dim, plan.choice.engine->id, plan.choice.reason);
}
RunPlan plan_one(const Rips& rips, const Options& options, const RunContext& context) {
  return detail::plan_rips(rips, options, context);
}

template <class Complex>
void build_one(const Complex& complex, const RunPlan& plan, const RunContext& context) {
  if (facts_of(plan.options.engine).listed_dim(*plan.options.max_dim) >= 0)
    prepare_cells(complex, context);
}
void build_one(const Rips& rips, const RunPlan& plan, const RunContext& context) {
  detail::build_rips(rips, plan, context);
}

template <class Complex>
Barcode run_one(const Complex& complex, const RunPlan& plan, const RunContext& context) {
  return detail::compute(complex, plan.options, context);
}
Barcode run_one(const ExplicitComplex& complex, const RunPlan& plan, const RunContext& context) {
  return persistence(complex, plan.options, context);
}
Barcode run_one(const Rips& rips, const RunPlan& plan, const RunContext& context) {
  return detail::run_rips(rips, plan, context);
}

}  // namespace

void detail::build_rips(const Rips& rips, const RunPlan& plan, const RunContext& context) {
  graph_of(rips, plan, context);
}

Barcode detail::run_rips(const Rips& rips, const RunPlan& plan, const RunContext& context) {
  Options options = plan.options;
  options.collapse = Collapse::off;  // edges are collapsed in this function or not at all
  const auto compute_graph = [&](const RipsGraph& graph) {
    return with_rips_filtration(graph, *options.max_dim, [&](const auto& filtration) {
      return bars_of(filtration, plan_for(filtration, options), options, context);
    });
  };
  const RipsGraph& graph = graph_of(rips, plan, context);
  Barcode bars = plan.options.collapse == Collapse::on
                     ? compute_graph(collapse_edges(graph, context))
                     : compute_graph(graph);
  BarcodeInfo info = info_of_task(options, *options.max_dim, options.engine);
  describe(rips, plan, info, context);
  bars.set_info(std::move(info));
  return bars;
}

RunPlan plan(const AnyComplex& complex, const Options& options, const RunContext& context) {
  return std::visit([&](const auto& c) { return plan_one(c, options, context); }, complex);
}

void build(const AnyComplex& complex, const RunPlan& plan, const RunContext& context) {
  std::visit([&](const auto& c) { build_one(c, plan, context); }, complex);
}

Barcode run(const AnyComplex& complex, const RunPlan& plan, const RunContext& context) {
  return std::visit([&](const auto& c) { return run_one(c, plan, context); }, complex);
}

Barcode run(AnyComplex&& complex, const RunPlan& plan, const RunContext& context) {
  build(complex, plan, context);
  if (auto* rips = std::get_if<Rips>(&complex); rips && rips->is_only_copy()) rips->forget_input();
  return run(std::as_const(complex), plan, context);
}

RunFacts facts(const AnyComplex& complex, const RunPlan& plan, const RunContext& context) {
  const auto* rips = std::get_if<Rips>(&complex);
  if (!rips) return {};
  const RipsGraph& graph = graph_of(*rips, plan, context);
  RunFacts facts;
  facts.vertices = graph.size();
  if (!graph.points_alone()) facts.edges = graph.edge_count();
  if (std::isfinite(graph.threshold())) facts.threshold = graph.threshold();
  facts.covering_radius = rips->covering_radius(context);
  return facts;
}

}  // namespace ph
