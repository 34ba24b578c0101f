// SPDX-License-Identifier: MIT
#include "barcode/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>

#include "barcode/arguments/option_scopes.hpp"
#include "barcode/complex/cubical_options.hpp"
#include "barcode/complex/load.hpp"
#include "barcode/memory/alternatives.hpp"
#include "barcode/memory/estimate_text.hpp"
#include "barcode/output/outputs.hpp"
#include "barcode/output/report.hpp"
#include "barcode/output/significance.hpp"
#include "barcode/output/stored.hpp"
#include "common/arguments/numbers.hpp"
#include "common/system/process.hpp"
#include "common/terminal/exit_code.hpp"
#include "common/terminal/messages.hpp"
#include "core/bytes/sealed_part.hpp"
#include "core/format_size.hpp"
#include "core/system/files.hpp"
#include "cubical/pair_voxels.hpp"
#include "facade/adjust.hpp"
#include "ph/detail/report/shown_tree.hpp"
#include "ph/estimate.hpp"
#include "ph/loops.hpp"

namespace ph::barcode {
namespace {

/// Layers that were asked for, or why they are not looked at one by one.
void explain_slabs(const BuiltComplex& built, const RunPlan& plan, const Arguments& arguments,
                   app::Session& session) {
  const int layers = arguments.common.slab_layers;
  const auto* cubical = std::get_if<Cubical>(&built.complex);
  if (layers == 0 || !cubical) return;
  const auto does_nothing = [&](std::string_view why) {
    session.note(fmt::format("--slab-layers does nothing: {}", why));
  };
  const Engine engine = plan.options.engine;
  if (facts_of(engine).listed_dim(0) >= 0)
    does_nothing(fmt::format("engine {} takes all of them at once", engine.name()));
  else if (arguments.options.representatives != Representatives::none)
    does_nothing("representatives need all of them at once");
  else if (!cubical::can_be_cut(cubical->cubical_image(),
                                {arguments.options.min_dim, *plan.options.max_dim}))
    does_nothing(cubical->cubical_image().extents.size() > 3
                     ? "of four axes or more bars of dimensions between 0 and the highest but one "
                       "need all of them at once"
                     : "no axis has more than one voxel");
  else
    session.explain(
        fmt::format("slabs of {}", app::count_of(static_cast<std::size_t>(layers), "layer")));
}

/// The files of the plots of the merge tree, in their order, before bars are computed, which may
/// take long: there may be no tree. @throws Error (usage) if there is none.
std::vector<std::string> pictures_of_tree(const Loaded& loaded, const Job& job,
                                          const Arguments& arguments, const RunContext& context) {
  const auto tree = in_name_of(loaded.name, [&] { return tree_of(loaded.built, context); });
  if (!tree)
    throw Error(ErrorKind::usage,
                fmt::format("--plot-kind tree: {} has no merge tree: expected no sample, no "
                            "approximation, --construction vertices, no --threshold on a listed "
                            "complex, and at most {} voxels",
                            loaded.name, report::kMostTreeVoxels));
  const MemoryClaim claim(context.memory, tree->births.size() * sizeof(Branch));
  const std::vector<Branch> branches = tree->branches();
  std::vector<std::string> pictures;
  for (const app::Plot& plot : job.plots)
    if (plot.kind == "tree")
      pictures.push_back(app::drawn(plot, std::span(branches),
                                    look_of(arguments.look, arguments.cubical.superlevel),
                                    context));
  return pictures;
}

/// Whether bars of H1 get loops: only JSON has room for them.
bool writes_loops(const Job& job, const Arguments& arguments) {
  const Representatives kind = arguments.options.representatives;
  return job.format == BarcodeFormat::json && arguments.loops != LoopChoice::none &&
         (kind == Representatives::cycles || kind == Representatives::voxels);
}

/// Before anything is computed. @throws Error (usage) if loops are asked for that cannot be had.
void require_loops(const BuiltComplex& built, const Arguments& arguments) {
  if (!arguments.loops || *arguments.loops == LoopChoice::none) return;
  const auto* listed = std::get_if<ExplicitComplex>(&built.complex);
  if (listed && listed->cell_kind() == CellKind::row)
    throw Error(ErrorKind::usage,
                "--loops: found a boundary matrix, expected cells with vertices to walk along");
  if (*arguments.loops == LoopChoice::tight && !std::holds_alternative<Rips>(built.complex))
    throw Error(ErrorKind::usage,
                fmt::format("--loops tight: found complex {}, expected rips; --loops plain gives "
                            "loops as they are found",
                            built.name));
}

/// @param is_stored receives whether the input is a barcode that was computed earlier.
Outcome run_once(const Job& job, const Arguments& arguments, app::Session& session,
                 bool& is_stored) {
  Stopwatch watch;
  std::optional<Outputs> outputs;
  if (!arguments.dry_run) outputs.emplace(job);
  std::optional<app::BarHold> somebody_types;
  if (app::is_typed({job.input, arguments.values, arguments.vertex_weights}))
    somebody_types.emplace(session);
  std::optional<Input> input(
      Input::open(files::path_of(job.input), &session.context(), Input::Excess::stays_in_file));
  if (is_sealed_part(input->bytes()))
    throw Error(ErrorKind::bad_data, fmt::format("{}: found a part of a result, expected data; "
                                                 "--join makes bars of all parts",
                                                 input->name()));
  is_stored = arguments.stored || (arguments.format == Format::automatic && is_barcode(*input));
  if (is_stored) {
    if (job.bars != nullptr)
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found a barcode, expected data", input->name()));
    app::require_in_scope(arguments.given, kBarcode, name_of(kBarcode));  // --dry-run is not
    return run_stored(job, *input, *outputs, arguments, session);
  }

  Loaded loaded = load(job, input, arguments, session, watch);
  somebody_types.reset();
  auto& [built, name, description, point_ids, data, claim] = loaded;
  require_loops(built, arguments);
  const auto taken = static_cast<double>(session.memory_taken());
  const auto note_promise = [&](const std::optional<std::string>& promise) {
    if (promise) session.note(fmt::format("{}: {}", name, *promise));
  };
  if (arguments.dry_run) {
    if (arguments.significance)
      session.note("--significance does nothing: --dry-run computes no bars");
    const Estimate estimated = in_name_of(
        name, [&] { return estimate(built.complex, arguments.options, session.context()); });
    take_facts(built, estimated.built);
    note_promise(promise_of(built, estimated.built));
    explain_slabs(built, estimated, arguments, session);
    const app::BarHold results_are_written(session);
    // The edges, if they were made, were not there before.
    const double held = estimated.built.edges ? estimated.bytes_held : 0;
    write_file("-", estimate_text(estimated, built, description, taken + held));
    return {app::kOk, description};
  }
  std::vector<std::string> trees;
  if (arguments.draws_tree()) {
    trees = pictures_of_tree(loaded, job, arguments, session.context());
    watch.lap("tree");
  }
  if (!job.surfaces.empty()) {
    outputs->write_surfaces(std::get<Alpha>(built.complex), *points_of(data->read), point_ids,
                            session.context());
    watch.lap("surfaces");
  }
  const RunPlan planned = in_name_of(name, [&] {
    RunPlan made = plan(built.complex, arguments.options, session.context());
    build(built.complex, made, session.context());
    return made;
  });
  const RunFacts known = facts(built.complex, planned, session.context());
  take_facts(built, known);
  const std::optional<std::string> promise = promise_of(built, known);
  note_promise(promise);
  // Points alone are the input itself.
  if (job.report.empty() && !arguments.check && planned.form != RipsForm::points) {
    if (auto* rips = std::get_if<Rips>(&built.complex)) rips->forget_input();
    data.reset();
    claim.reset();
  }
  watch.lap("complex");
  const std::string_view engine = planned.options.engine.name();
  session.explain(fmt::format("engine {}: {}", engine, planned.reason));
  if (!planned.collapse_reason.empty())
    session.explain(fmt::format("collapse {} ({})",
                                planned.options.collapse == Collapse::on ? "on" : "off",
                                planned.collapse_reason));

  explain_slabs(built, planned, arguments, session);

  RunPlan settled = planned;
  // A bar that the threshold cuts is infinite, however short it would have been.
  if (built.cut) settled.options.min_persistence = std::min(settled.options.min_persistence, 0.0);
  const auto compute = [&](const AnyComplex& complex) {
    Barcode bars = run(complex, settled, session.context());
    if (built.cut) bars = cut_at(bars, complex, *built.cut, arguments.options.min_persistence);
    return bars;
  };
  Barcode barcode = compute(built.complex);
  watch.lap("persistence");
  std::vector<BarLoops> loops_of_bars;
  if (writes_loops(job, arguments)) {
    loops_of_bars =
        loops(built.complex, barcode, settled.options,
              arguments.loops.value_or(LoopChoice::tight) == LoopChoice::tight, session.context());
    watch.lap("loops");
  }
  const MemoryClaim claim_of_loops(session.context().memory, bytes_of(loops_of_bars));
  // Points may have become an image, whose cells are named by coordinates.
  if (!point_ids.empty() && barcode.cell_kind() == CellKind::vertices) {
    barcode = with_input_ids(barcode, point_ids);
    name_points(loops_of_bars, point_ids);
  }

  int code = app::kOk;
  std::vector<std::string> warnings;
  if (arguments.check) {
    settled.options.engine = Engine::standard;
    settled.options.collapse = Collapse::off;
    settled.options.representatives = Representatives::none;
    if (settled.form) settled.form = RipsForm::edges;
    const std::string difference = first_difference(
        barcode, built.by_definition ? compute(built.by_definition(session.context()))
                                     : compute(built.complex));
    watch.lap("check");
    if (difference.empty()) {
      session.explain("check: the reference engine agrees");
    } else {
      app::print_line(
          fmt::format("ph-barcode: {}: check: engine {} and the reference engine differ: {}",
                      job.input, engine, difference));
      warnings.push_back("check: the engine and the reference engine differ: " + difference);
      code = app::kDifference;
    }
  }

  const std::vector<double> p_values =
      arguments.significance ? p_values_of(barcode, std::holds_alternative<Alpha>(built.complex)
                                                        ? DistanceFiltration::cech
                                                        : DistanceFiltration::rips)
                             : std::vector<double>();
  BarcodeInfo info;
  info.program = app::program_and_version("ph-barcode");
  info.input = job.input;
  info.input_description = description;
  info.complex = built.name;
  info.field = arguments.options.field;
  info.max_dim = arguments.options.max_dim.value_or(*planned.options.max_dim);
  info.threshold = built.threshold;
  info.metric = built.metric;
  info.vertex_weights = built.vertex_weights;
  info.subsample = built.subsample;
  info.voxels = built.voxels;
  info.alpha = built.alpha;
  if (built.cubical) describe(*built.cubical, info);
  info.approximation = arguments.rips.approximation;
  info.min_persistence = arguments.options.min_persistence;
  info.min_dim = arguments.options.min_dim;
  info.loops = loops_of_bars;
  info.p_values = p_values;
  info.engine = engine;
  info.timings = watch.laps();
  info.peak_memory = app::peak_memory();
  for (const auto& [stage, seconds] : watch.laps())
    session.explain(fmt::format("{} {:.3f} s", stage, seconds));
  session.explain("memory " + format_size(static_cast<double>(session.memory_taken())));
  note_absent_dims(barcode, arguments.look, session);
  const app::BarHold results_are_written(session);
  outputs->write(barcode, info, look_of(arguments.look, arguments.cubical.superlevel), trees,
                 session.context());
  if (!job.report.empty()) {
    const Shown shown{barcode, info, *data, built, planned.form, promise, std::move(warnings)};
    write_report(outputs->report().file(), shown, arguments, session);
    outputs->report().commit();
  }
  std::string summary = fmt::format("{}: {}", description, app::count_of(barcode.size(), "bar"));
  if (job.bars != nullptr) *job.bars = std::move(barcode);
  return {code, std::move(summary)};
}

}  // namespace

Outcome run(const Job& job, const Arguments& arguments, app::Session& session) {
  std::string what;
  bool is_stored = false;
  try {
    return run_once(job, arguments, session, is_stored);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    what = error.what();
  } catch (const std::bad_alloc&) {
    what = "out of memory";
  }
  // By now all that the run held has been given back; the heap keeps none of it.
  app::give_back_freed_memory();
  session.loosen_heap_bound();
  const std::string peak = format_size(static_cast<double>(session.memory_taken()));
  if (is_stored)
    throw Error(ErrorKind::resource, fmt::format("{}; peak {}; {}", what, peak, kFewerBars));
  if (const std::string changes = alternatives(job, arguments, session); !changes.empty())
    throw Error(ErrorKind::resource,
                fmt::format("{}; peak {}; {}; or raise --memory-limit", what, peak, changes));
  throw Error(ErrorKind::resource, fmt::format("{}; peak {}", what, peak));
}

}  // namespace ph::barcode
