// SPDX-License-Identifier: MIT
#include "apps/barcode/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/complex/cubical_options.hpp"
#include "apps/barcode/complex/load.hpp"
#include "apps/barcode/memory/estimate_text.hpp"
#include "apps/barcode/output/outputs.hpp"
#include "apps/barcode/output/report.hpp"
#include "apps/barcode/output/significance.hpp"
#include "apps/barcode/output/stored.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/messages.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/core/sealed_part.hpp"
#include "ph/detail/cubical/pair_voxels.hpp"
#include "ph/detail/facade/adjust.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/detail/report/shown_tree.hpp"
#include "ph/estimate.hpp"
#include "ph/loops.hpp"

namespace ph::barcode {
namespace {

/// Reports how --slab-layers is applied, or why it has no effect.
void explain_slabs(const BuiltComplex& built, const RunPlan& plan, const Job& job,
                   app::Session& session) {
  const int layers = job.common.slab_layers;
  const auto* cubical = std::get_if<Cubical>(&built.complex);
  if (layers == 0 || !cubical) return;
  const auto does_nothing = [&](std::string_view why) {
    session.note(fmt::format("--slab-layers does nothing: {}", why));
  };
  const Engine engine = plan.options.engine;
  if (facts_of(engine).listed_dim(0) >= 0)
    does_nothing(fmt::format("engine {} processes all layers at once", engine.name()));
  else if (job.question.options.representatives != Representatives::none)
    does_nothing("representatives need all layers at once");
  else if (!cubical::can_be_cut(cubical->cubical_image(),
                                {job.question.options.min_dim, *plan.options.max_dim}))
    does_nothing(cubical->cubical_image().extents.size() > 3
                     ? "with n >= 4 axes, bars of dimensions 1 to n - 2 need all layers at once"
                     : "no axis has more than one voxel");
  else
    session.explain(
        fmt::format("slabs of {}", app::count_of(static_cast<std::size_t>(layers), "layer")));
}

/// Draws the plots of the merge tree, in the order of the plots. They are drawn before the bars are
/// computed, because a missing tree should be reported before a long computation.
/// @throws Error (usage) if there is no tree.
std::vector<std::string> pictures_of_tree(const Loaded& loaded, const Job& job,
                                          const RunContext& context) {
  const auto tree = in_name_of(loaded.name, [&] { return tree_of(loaded.built, context); });
  if (!tree)
    throw Error(ErrorKind::usage,
                fmt::format("--plot-kind tree: {} has no merge tree: expected no sample, no "
                            "approximation, no periodic space and no point that enters above the "
                            "threshold; for images, --construction vertices and at most {} "
                            "voxels; for simplices, boundary matrices and meshes, edges that join "
                            "two vertices and no --threshold",
                            loaded.name, report::kMostTreeVoxels));
  const MemoryClaim claim(context.memory, tree->births.size() * sizeof(Branch));
  const std::vector<Branch> branches = tree->branches();
  std::vector<std::string> pictures;
  for (const app::Plot& plot : job.places.plots)
    if (plot.kind == "tree")
      pictures.push_back(app::drawn(plot, std::span(branches),
                                    look_of(job.results.look, job.question.cubical.superlevel),
                                    context));
  return pictures;
}

/// True if bars of H1 get loops. Only JSON has room for loops.
bool writes_loops(const Job& job) {
  const Representatives kind = job.question.options.representatives;
  return job.places.format == BarcodeFormat::json && job.results.loops != LoopChoice::none &&
         (kind == Representatives::cycles || kind == Representatives::voxels);
}

/// Must be called before the computation. @throws Error (usage) if the requested loops cannot be
/// computed.
void require_loops(const BuiltComplex& built, const Job& job) {
  if (!job.results.loops || *job.results.loops == LoopChoice::none) return;
  const auto* listed = std::get_if<ExplicitComplex>(&built.complex);
  if (listed && listed->cell_kind() == CellKind::row)
    throw Error(ErrorKind::usage,
                "--loops: found a boundary matrix, expected "
                "cells with vertices to walk along");
  if (*job.results.loops == LoopChoice::tight && !std::holds_alternative<Rips>(built.complex))
    throw Error(ErrorKind::usage, fmt::format("--loops tight: found complex {}, expected rips; "
                                              "--loops plain gives "
                                              "loops as they are found",
                                              built.name));
}

/// The points whose means are the places of bars. Empty if there are no points with coordinates, if
/// cells are cubes of an image, or if coordinates are taken modulo the lengths of a space.
std::optional<PointsView> points_with_places(const Loaded& loaded) {
  const auto* alpha = std::get_if<Alpha>(&loaded.built.complex);
  if (!loaded.data || std::holds_alternative<Cubical>(loaded.built.complex) ||
      (alpha && alpha->is_periodic()))
    return std::nullopt;
  return app::points_of(loaded.data->read);
}

/// Must be called before the computation. @throws Error (usage) if CSV is the only output for
/// cycles, but has no places of them.
void require_places(const Loaded& loaded, const Job& job) {
  if (!job.writes_centroids() || !job.places.report.empty() || points_with_places(loaded)) return;
  throw Error(ErrorKind::usage,
              fmt::format("--representatives: found output format csv for {}, whose cycles have no "
                          "places, expected points with coordinates, or json; use --output-format "
                          "json or -o FILE.json",
                          loaded.description));
}

/// The results computed from a complex.
struct Result {
  Barcode bars;
  Points centroids;  ///< of the bars, in CSV
  std::vector<BarLoops> loops;
  std::vector<std::string> warnings;
  int code = app::kOk;
};

/// One run, in stages: open, load, plan, compute, check, write.
class Run {
 public:
  Run(const Job& job, app::Session& session) : job_(job), session_(session) {}

  /// @throws Error.
  Outcome operator()() {
    // Opened early, to report a file that cannot be created.
    std::optional<Outputs> outputs;
    if (!job_.results.dry_run) outputs.emplace(job_.places);
    std::optional<Input> input(open());
    if (is_stored_) return run_stored(job_, *input, *outputs, session_);
    Loaded loaded = load(job_, input, session_, watch_);
    typing_.reset();
    require_loops(loaded.built, job_);
    if (job_.results.dry_run) return show_estimate(loaded);
    require_places(loaded, job_);

    const RunPlan plan = plan_and_build(loaded);
    const std::vector<std::string> trees = draw_trees(loaded);
    write_surfaces(loaded, *outputs);
    give_back_data(loaded, plan);
    Result result = compute(loaded, plan);
    const MemoryClaim claim(context().memory, bytes_of(result.loops));
    if (job_.results.check) check(loaded, plan, result);
    return write(loaded, plan, std::move(result), trees, *outputs);
  }

  /// True once it is known that the input is a barcode that was computed earlier.
  bool is_stored() const { return is_stored_; }

 private:
  const RunContext& context() const { return session_.context(); }

  Input open() {
    if (app::is_typed({job_.places.input, job_.reading.values, job_.question.vertex_weights}))
      typing_.emplace(session_);
    const auto check = [&](const Input& start) {
      if (is_sealed_part(start.bytes())) return;  // the message below says more
      (job_.stored ? barcode_start_check() : detail::start_check(job_.reading.format))(start);
    };
    Input input =
        open_input(job_.places.input, job_, context(), Input::Excess::stays_in_file, check);
    if (job_.reading.options.stack) return input;
    if (is_sealed_part(input.bytes()))
      throw Error(ErrorKind::bad_data, fmt::format("{}: found a part of a result, expected data; "
                                                   "--join makes bars from all parts",
                                                   mark_place(input.name())));
    is_stored_ = job_.stored || (job_.reading.format == Format::automatic && is_barcode(input));
    if (!is_stored_) return input;
    if (job_.places.bars != nullptr)
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found a barcode, expected data", mark_place(input.name())));
    app::require_in_scope(job_.given, kBarcode,
                          name_of(kBarcode));  // this also refuses --dry-run
    return input;
  }

  Outcome show_estimate(Loaded& loaded) {
    const auto taken = static_cast<double>(session_.memory_taken());
    if (job_.results.significance)
      session_.note("--significance does nothing: --dry-run computes no bars");
    if (!job_.results.look.dims.empty())
      session_.note("--dims does nothing: --dry-run computes no bars");
    const Estimate estimated = in_name_of(loaded.name, [&] {
      return estimate(loaded.built.complex, job_.question.options, context());
    });
    take_facts(loaded, estimated.built);
    explain_slabs(loaded.built, estimated, job_, session_);
    const app::BarHold results_are_written(session_);
    // If only the estimate listed the edges, the memory of the edges is added to the memory that
    // was in use before.
    const double held = estimated.built.edges ? estimated.bytes_held : 0;
    write_file("-", estimate_text(estimated, loaded.built, loaded.description, taken + held));
    return {app::kOk, loaded.description};
  }

  std::vector<std::string> draw_trees(const Loaded& loaded) {
    if (!job_.draws_tree()) return {};
    std::vector<std::string> trees = pictures_of_tree(loaded, job_, context());
    watch_.lap("tree");
    return trees;
  }

  void write_surfaces(const Loaded& loaded, Outputs& outputs) {
    if (job_.places.surfaces.empty()) return;
    outputs.write_surfaces(std::get<Alpha>(loaded.built.complex),
                           *app::points_of(loaded.data->read), loaded.point_ids, context());
    watch_.lap("surfaces");
  }

  RunPlan plan_and_build(Loaded& loaded) {
    const AnyComplex& complex = loaded.built.complex;
    RunPlan plan = in_name_of(loaded.name, [&] {
      RunPlan made = ph::plan(complex, job_.question.options, context());
      build(complex, made, context());
      return made;
    });
    take_facts(loaded, facts(complex, plan, context()));
    watch_.lap("complex");
    session_.explain(fmt::format("engine {}: {}", plan.options.engine.name(), plan.reason));
    if (!plan.collapse_reason.empty())
      session_.explain(fmt::format("collapse {} ({})",
                                   plan.options.collapse == Collapse::on ? "on" : "off",
                                   plan.collapse_reason));
    explain_slabs(loaded.built, plan, job_, session_);
    return plan;
  }

  /// Reports the facts about the complex that are known only after it is built.
  void take_facts(Loaded& loaded, const RunFacts& facts) {
    barcode::take_facts(loaded.built, facts);
    promise_ = promise_of(loaded.built, facts);
    if (promise_) session_.note(fmt::format("{}: {}", loaded.name, *promise_));
  }

  /// Frees the data if the complex alone is enough. This is the case if no output shows the data,
  /// and neither --check nor the computation uses them.
  void give_back_data(Loaded& loaded, const RunPlan& plan) const {
    if (!job_.places.report.empty() || job_.results.check || job_.writes_centroids() ||
        plan.form == RipsForm::points)
      return;
    if (auto* rips = std::get_if<Rips>(&loaded.built.complex)) rips->forget_input();
    loaded.data.reset();
    loaded.claim.reset();
  }

  Result compute(const Loaded& loaded, const RunPlan& plan) {
    Result result{ph::run(loaded.built.complex, plan, context()), {}, {}, {}};
    watch_.lap("persistence");
    if (const auto points = points_with_places(loaded); points && job_.writes_centroids())
      result.centroids = centroids(result.bars, *points, context());
    if (writes_loops(job_)) {
      const bool is_tight = job_.results.loops.value_or(LoopChoice::tight) == LoopChoice::tight;
      result.loops = loops(loaded.built.complex, result.bars, plan.options, is_tight, context());
      watch_.lap("loops");
    }
    // Points may have become an image, whose cells are named by coordinates.
    // mutant: point-ids
    if (!loaded.point_ids.empty() && result.bars.cell_kind() == CellKind::vertices) {
      const MemoryClaim claim(context().memory, bytes_of(result.loops));
      result.bars = with_input_ids(result.bars, loaded.point_ids);
      name_points(result.loops, loaded.point_ids);
    }
    return result;
  }

  /// Compares the bars with the bars of the oracle, over all edges of a Rips filtration.
  void check(const Loaded& loaded, RunPlan plan, Result& result) {
    const std::string_view engine = plan.options.engine.name();
    plan.options.engine = Engine::standard;
    plan.options.collapse = Collapse::off;
    plan.options.representatives = Representatives::none;
    if (plan.form) plan.form = RipsForm::edges;
    const auto& by_definition = loaded.built.by_definition;
    const AnyComplex complex = by_definition ? by_definition(context()) : loaded.built.complex;
    const std::string difference = first_difference(result.bars, ph::run(complex, plan, context()));
    watch_.lap("check");
    if (difference.empty()) {
      session_.explain("check: the reference engine agrees");
      return;
    }
    app::print_line(
        fmt::format("ph-barcode: {}: check: engine {} and the reference engine differ: {}",
                    job_.places.input, engine, difference));
    result.warnings.push_back("check: the engine and the reference engine differ: " + difference);
    result.code = app::kDifference;
  }

  /// Adds the facts that this program knows to the facts that the library states.
  BarcodeInfo completed(BarcodeInfo info, const Loaded& loaded) const {
    const BuiltComplex& built = loaded.built;
    info.program = app::program_and_version("ph-barcode");
    info.input = job_.places.input;
    info.input_description = loaded.description;
    info.points = loaded.points;
    info.coordinates = loaded.coordinates;
    info.affine = loaded.affine;
    info.nan_dropped = loaded.nan_dropped;
    info.complex = built.name;
    info.max_dim = job_.question.options.max_dim.value_or(info.max_dim);
    info.threshold = built.threshold;
    info.vertex_weights = built.vertex_weights;
    info.voxels = built.voxels;
    info.timings = watch_.laps();
    info.peak_memory = app::peak_memory();
    return info;
  }

  Outcome write(const Loaded& loaded, const RunPlan& plan, Result&& result,
                std::span<const std::string> trees, Outputs& outputs) {
    std::vector<double> p_values;
    if (job_.results.significance)
      p_values = p_values_of(result.bars, std::holds_alternative<Alpha>(loaded.built.complex)
                                              ? DistanceFiltration::cech
                                              : DistanceFiltration::rips);
    result.bars.set_info(completed(result.bars.info(), loaded));
    for (const auto& [stage, seconds] : watch_.laps())
      session_.explain(fmt::format("{} {:.3f} s", stage, seconds));
    session_.explain("memory " + format_size(static_cast<double>(session_.memory_taken())));
    note_absent_dims(result.bars, job_.results.look, session_);
    const app::BarHold results_are_written(session_);
    outputs.write(result.bars,
                  {.loops = result.loops, .p_values = p_values, .centroids = result.centroids},
                  look_of(job_.results.look, job_.question.cubical.superlevel), trees, context());
    if (!job_.places.report.empty()) {
      const Shown shown{result.bars, *loaded.data, loaded.built,
                        plan.form,   promise_,     std::move(result.warnings)};
      write_report(outputs.report().file(), shown, job_, session_);
      outputs.report().commit();
    }
    std::string summary =
        fmt::format("{}: {}", loaded.description, app::count_of(result.bars.size(), "bar"));
    if (job_.places.bars != nullptr) *job_.places.bars = std::move(result.bars);
    return {result.code, std::move(summary)};
  }

  const Job& job_;
  app::Session& session_;
  Stopwatch watch_;
  // No progress bar is drawn while somebody types the input.
  std::optional<app::BarHold> typing_;
  std::optional<std::string> promise_;  // the accuracy of an approximation
  bool is_stored_ = false;
};

}  // namespace

Outcome run(const Job& job, app::Session& session) {
  std::string what;
  Run once(job, session);
  try {
    return once();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    what = error.marked();
  } catch (const std::bad_alloc&) {
    what = "out of memory";
  }
  // Everything that the run stored has been freed by now. This call makes the heap return the
  // memory to the system.
  app::give_back_freed_memory();
  session.loosen_heap_bound();
  const std::string peak = format_size(static_cast<double>(session.memory_taken()));
  if (once.is_stored())
    throw Error(ErrorKind::resource, fmt::format("{}; peak {}; {}", what, peak, fewer_bars()));
  if (const std::string changes = alternatives(job, session); !changes.empty())
    throw Error(ErrorKind::resource, fmt::format("{}; peak {}; {}; or raise {}", what, peak,
                                                 changes, mark(Setting::memory_limit)));
  throw Error(ErrorKind::resource, fmt::format("{}; peak {}", what, peak));
}

}  // namespace ph::barcode
