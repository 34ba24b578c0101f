// SPDX-License-Identifier: MIT
#include "libph/src/facade/rips_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ph/detail/facade/choose_engine.hpp"
#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/detail/rips/rips_graph.hpp"

namespace ph::detail {
namespace {

// Any filtration type with this layout is suitable, because engines depend only on the kind of a
// filtration, not on the size of its cells.
using Sparse = RipsFiltration<RipsLayout::sparse, 1>;

// A collapse is worthwhile if at least this share of the edges is dominated, as measured for H2 to
// H7. The more edges are dominated, the more time a collapse saves, up to a factor of a few
// hundred. If two thirds of the edges are dominated, a collapse still saves half of the time and of
// the memory. If fewer edges are dominated, nearly all edges are kept, and the collapse wastes
// time. Examples are spheres of higher dimension and distances that are not a metric.
constexpr double kWorthwhileShare = 0.6;
// If homology is computed only up to this dimension or a lower one, the engine is chosen without
// the dimension of the complex, because finding that dimension takes a long time.
constexpr int kHighestByEdges = 3;

/// The reason why a collapse would spoil the result, or an empty text if it would not.
std::string_view obstacle_to_collapse(const Options& options) {
  // mutant: collapse-zero-length
  if (options.min_persistence < 0) return "bars of length zero are requested";
  if (options.representatives == Representatives::cocycles)
    return "cocycles are requested, and cocycles on the remaining edges have no values on the "
           "removed ones";
  return {};
}

struct CollapseChoice {
  bool collapses;
  std::string reason;
};
/// Decides whether edges are collapsed. @param dominated returns the share of dominated edges;
/// called only if the decision depends on that share.
/// @throws Error (usage) if a requested collapse would spoil the result.
template <class Dominated>
CollapseChoice choose_collapse(const EngineFacts& engine, const Options& options,
                               Dominated&& dominated) {
  if (options.collapse == Collapse::off) return {false, "requested"};
  const std::string_view spoilt = obstacle_to_collapse(options);
  if (options.collapse == Collapse::on) {
    if (!spoilt.empty())
      throw Error(ErrorKind::usage, fmt::format("edge collapse is not possible: {}", spoilt));
    return {true, "requested"};
  }
  if (!spoilt.empty()) return {false, std::string(spoilt)};
  if (engine.goes_by_edges) return {false, "the engine looks only at edges"};
  if (engine.is_oracle) return {false, "the reference engine takes the complex as it is"};
  const double share = dominated();
  return {share >= kWorthwhileShare,
          fmt::format("{:.0f} % of a sample of the edges are dominated", 100 * share)};
}

/// True if only a spanning forest is available.
bool is_forest_alone(const Rips& rips) {
  return rips.has_form(RipsForm::forest) && !rips.has_form(RipsForm::edges) &&
         !rips.has_form(RipsForm::distinct_edges);
}

/// The highest dimension to compute.
/// @throws Error (usage) if `check` refuses the options. Also throws if no highest dimension was
/// given and the lowest dimension is above the highest dimension, or if the highest dimension is
/// above 0 and only a spanning forest is available.
int max_dim_of(const Rips& rips, const Options& options) {
  const bool is_forest = is_forest_alone(rips);
  check(options);
  const int max_dim = options.max_dim.value_or(is_forest ? 0 : 1);
  if (is_forest && max_dim > 0) {
    throw Error(
        ErrorKind::usage,
        fmt::format("highest dimension: found {}, expected 0: this Rips filtration has only "
                    "components",
                    max_dim));
  }
  if (!options.max_dim && options.min_dim > max_dim) {
    throw Error(ErrorKind::usage,
                fmt::format("lowest dimension: found {}, expected at most {}, the default of the "
                            "highest dimension",
                            options.min_dim, max_dim));
  }
  return max_dim;
}

/// An upper bound for the number of vertices.
Index most_vertices(const Rips& rips) {
  const RipsOptions& options = rips.options();
  if (options.subsample) return std::min(rips.size(), options.subsample->points);
  return options.vertices.empty() ? rips.size() : static_cast<Index>(options.vertices.size());
}

/// An engine, the form that it will use, and the reason for choosing the engine.
struct FormChoice {
  const EngineFacts* engine = nullptr;
  RipsForm form = RipsForm::edges;
  std::string_view reason;
};

/// Makes a plan from the given choices. @param options must include the highest dimension.
RunPlan planned(const Options& options, const FormChoice& choice, CollapseChoice&& collapse) {
  RunPlan plan = run_plan(options, *options.max_dim, choice.engine->id, choice.reason);
  plan.form = choice.form;
  plan.options.collapse = collapse.collapses ? Collapse::on : Collapse::off;
  plan.collapse_reason = std::move(collapse.reason);
  if (choice.form == RipsForm::forest) plan.reason += "; a spanning forest gives them";
  return plan;
}

/// The form that provides the edges for a task. It is a spanning forest if nothing else is
/// available. Otherwise it is all edges or the edges of distinct points.
RipsForm edges_for(const Rips& rips, const Options& options) {
  if (is_forest_alone(rips)) return RipsForm::forest;
  const RipsOptions& asked = rips.options();
  const bool may_merge = options.min_persistence >= 0 &&
                         options.representatives != Representatives::cocycles && !rips.has_births();
  return rips.has_form(RipsForm::distinct_edges) && asked.merge_equal_points.value_or(may_merge)
             ? RipsForm::distinct_edges
             : RipsForm::edges;
}

/// The first form that the engine accepts and the input can provide, or nothing.
std::optional<RipsForm> form_for(const EngineFacts& engine, const Rips& rips,
                                 const Options& options) {
  if (engine.rips_forms.empty()) return edges_for(rips, options);
  for (const RipsForm form : engine.rips_forms)
    if (rips.has_form(form)) return form == RipsForm::edges ? edges_for(rips, options) : form;
  return std::nullopt;
}

/// The condition of an engine that the input does not meet, or an empty text if the input meets all
/// conditions.
std::string_view obstacle_to(const EngineFacts& engine, const RipsInput& input, const Task& task) {
  return engine.rips_obstacle ? engine.rips_obstacle(input, task) : std::string_view();
}

/// The requested engine, or otherwise the most suitable engine, as far as it can be determined
/// without edges. @param vertices the number of vertices of the task. @return no engine if none can
/// do the task.
/// @throws Error (usage) if the input does not meet a condition of the requested engine.
FormChoice choose_form(const Rips& rips, const Options& options, int max_dim, Index vertices) {
  const RipsInput input{vertices, rips.points(), rips.options()};
  const Task task = task_of(options, max_dim);
  const bool is_asked = options.engine != Engine::automatic;
  const RipsGraph no_edges = RipsGraph::of_edges(vertices, {}, std::nullopt, default_context());
  const Sparse filtration(no_edges);
  FormChoice choice;
  int rank = 0;
  for (const EngineFor<Sparse>& engine : engines<Sparse>()) {
    if (is_asked && engine.id != options.engine) continue;
    const std::string_view obstacle = obstacle_to(engine, input, task);
    if (is_asked && !obstacle.empty())
      throw Error(ErrorKind::usage,
                  fmt::format("engine {}: expected {}", engine.id.name(), obstacle));
    const std::optional<RipsForm> form = form_for(engine, rips, options);
    const bool can_run = engine.rips_obstacle ? obstacle.empty() : engine.can_run(filtration, task);
    if (!form || !can_run) continue;
    const Suitability suits = is_asked                  ? Suitability{1, "requested"}
                              : engine.rips_suitability ? engine.rips_suitability(input, task)
                                                        : engine.suitability(filtration, task);
    if (suits.rank <= rank) continue;
    rank = suits.rank;
    choice = {&engine, *form, suits.reason};
  }
  return choice;
}

/// Makes a plan that depends on the edges.
RunPlan plan_by_edges(const Rips& rips, const Options& options, RipsForm form,
                      const RunContext& context) {
  const int max_dim = *options.max_dim;
  const RipsGraph& graph = rips.graph(form, context);
  const auto choice = choose_engine(Sparse(graph), options.engine, task_of(options, max_dim));
  CollapseChoice collapse =
      choose_collapse(*choice.engine, options, [&] { return dominated_share(graph, context); });
  // The top dimension is not known before the collapse.
  if (collapse.collapses)
    return planned(options, {choice.engine, form, choice.reason}, std::move(collapse));
  Options settled = options;
  settled.collapse = Collapse::off;
  return with_rips_filtration(graph, max_dim, [&](const auto& filtration) {
    const auto plan = plan_for(filtration, settled);
    settled.max_dim = plan.max_dim;
    return planned(settled, {plan.choice.engine, form, plan.choice.reason}, std::move(collapse));
  });
}

/// The decisions that are made before any edges are listed.
struct Settled {
  Settled(const Rips& rips, Options asked) : options(std::move(asked)) {
    const int max_dim = max_dim_of(rips, options);
    options.max_dim = max_dim;
    choice = choose_form(rips, options, max_dim, most_vertices(rips));
    if (!choice.engine && options.engine == Engine::automatic &&
        !choose_form(rips, options, max_dim, 1).engine)
      // Refuses tasks that are impossible whatever the edges are.
      refuse(options.engine, task_of(options, max_dim));
    goes_by_edges = choice.engine && choice.engine->goes_by_edges && max_dim <= kHighestByEdges;
    if (!goes_by_edges) choice.form = edges_for(rips, options);
    if (rips.options().device == Device::gpu && choice.form != RipsForm::forest)
      throw Error(ErrorKind::usage,
                  "device gpu: found a task for the CPU only, expected components (H0) of points "
                  "with Euclidean distances; set max_dim to 0 and choose neither an approximation "
                  "nor an engine");
  }
  Options options;             // the options include the highest dimension
  FormChoice choice;           // no engine if no engine can do the task for this number of vertices
  bool goes_by_edges = false;  // true if the edges do not affect the plan
};

}  // namespace

RunPlan plan_rips(const Rips& rips, const Options& options, const RunContext& context) {
  const Settled settled(rips, options);
  if (!settled.goes_by_edges)
    return plan_by_edges(rips, settled.options, settled.choice.form, context);
  return planned(settled.options, settled.choice,
                 choose_collapse(*settled.choice.engine, settled.options, [] { return 0.0; }));
}

std::optional<RipsForm> form_without_edges(const Rips& rips, const Options& options) {
  const Settled settled(rips, options);
  const bool has_edges =
      settled.choice.form == RipsForm::edges || settled.choice.form == RipsForm::distinct_edges;
  return has_edges ? std::nullopt : std::optional(settled.choice.form);
}

RunPlan plan_without_edges(const Rips& rips, const Options& options) {
  const Settled settled(rips, options);
  if (!settled.choice.engine)
    refuse(options.engine, task_of(settled.options, *settled.options.max_dim));
  if (settled.goes_by_edges || settled.options.collapse != Collapse::automatic)
    return planned(settled.options, settled.choice,
                   choose_collapse(*settled.choice.engine, settled.options, [] { return 0.0; }));
  return planned(settled.options, settled.choice, {false, "not known without the edges"});
}

RipsForm form_of_tree(const Rips& rips) {
  return rips.has_form(RipsForm::forest) ? RipsForm::forest : RipsForm::edges;
}

}  // namespace ph::detail
