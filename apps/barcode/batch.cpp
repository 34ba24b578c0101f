// SPDX-License-Identifier: MIT
#include "apps/barcode/batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/output/report.hpp"
#include "apps/barcode/output/significance.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "apps/barcode/run.hpp"
#include "apps/common/files/batch_names.hpp"
#include "apps/common/files/extensions.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/run/program.hpp"
#include "apps/common/terminal/exit_code.hpp"

namespace ph::barcode {
namespace {

/// Only JSON and the report have room for representatives, and only JSON has room for loops.
/// @throws Error (usage).
void require_room(BarcodeFormat format, const Arguments& arguments) {
  if (!arguments.dry_run) require_significance(format, arguments);
  if (arguments.options.representatives == Representatives::none || arguments.dry_run) return;
  if (arguments.loops && format != BarcodeFormat::json)
    throw Error(
        ErrorKind::usage,
        fmt::format("--loops: found output format {}, expected json; --output-format json or "
                    "-o FILE.json holds them",
                    barcode_format_name(format)));
  if (!arguments.report.empty() || format == BarcodeFormat::json) return;
  throw Error(ErrorKind::usage,
              fmt::format("--representatives: found output format {}, expected json; "
                          "--output-format json or -o FILE.json holds them",
                          barcode_format_name(format)));
}

/// The options that give each input of a batch its own output, instead of folders and `*`.
Job job_of(const std::string& input, const std::string& name, const Arguments& arguments,
           BarcodeFormat format) {
  Job job{input, arguments.output, format};
  if (format != BarcodeFormat::none)
    job.output =
        app::filled(arguments.output, name, fmt::format(".{}", barcode_format_name(format)));
  job.plots = arguments.plots;
  for (app::Plot& plot : job.plots) plot.path = app::filled(plot.path, name, ".svg");
  job.report = app::filled(arguments.report, name, ".html");
  job.surfaces = arguments.surfaces;
  for (Surface& surface : job.surfaces) surface.path = app::filled(surface.path, name, ".ply");
  return job;
}

/// One job per input.
std::vector<Job> jobs_of(const Arguments& arguments, const std::vector<std::string>& inputs,
                         BarcodeFormat format) {
  if (!arguments.is_batch())
    return {{inputs.front(), arguments.output, format, arguments.plots, arguments.report,
             arguments.surfaces}};
  const std::string& output = arguments.output;
  const bool is_place = app::names_each(output) || (output != "-" && app::is_folder(output));
  if (format != BarcodeFormat::none && !is_place && !arguments.dry_run)
    throw Error(
        ErrorKind::usage,
        fmt::format("--output: several inputs need a folder: -o FOLDER/, found '{}'", output));
  const std::vector<std::string> names = app::output_names(inputs);
  const bool writes = format != BarcodeFormat::none || !arguments.plots.empty() ||
                      !arguments.report.empty() || !arguments.surfaces.empty();
  std::map<std::string, std::string> taken;
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [other, fresh] = taken.emplace(names[i], inputs[i]);
    jobs.push_back(job_of(inputs[i], names[i], arguments, format));
    if (!fresh && writes && !arguments.dry_run)
      throw Error(ErrorKind::usage, fmt::format("--output: {} and {} would both be written to {}",
                                                other->second, inputs[i], jobs.back().output));
  }
  return jobs;
}

/// Creates the folders of a batch.
void prepare_folders(const Arguments& arguments, BarcodeFormat format) {
  if (format != BarcodeFormat::none) app::prepare_outputs("--output", arguments.output);
  for (const app::Plot& plot : arguments.plots) app::prepare_outputs(plot.option, plot.path);
  app::prepare_outputs("--report", arguments.report);
  for (const Surface& surface : arguments.surfaces)
    app::prepare_outputs(surface.option(), surface.path);
}

/// No output may replace an input or another output. @throws Error (usage).
void require_separate(const app::InputFiles& inputs, const std::vector<app::Written>& outputs,
                      const Arguments& arguments, app::Session& session) {
  const bool replaces = app::require_separate(inputs, outputs, arguments.common.force);
  if (!arguments.common.force || replaces) return;
  if (arguments.dry_run)
    session.note("--force does nothing: --dry-run writes no file");
  else
    session.explain("--force: not needed, no output is an input");
}
void require_separate(const std::vector<Job>& jobs, const Arguments& arguments,
                      app::Session& session) {
  app::InputFiles inputs;
  std::vector<app::Written> outputs;
  for (const Job& job : jobs) {
    inputs.add(job.input);
    if (arguments.dry_run) continue;
    if (job.format != BarcodeFormat::none) outputs.push_back({"--output", job.output});
    for (const app::Plot& plot : job.plots) outputs.push_back({plot.option, plot.path});
    if (!job.report.empty()) outputs.push_back({"--report", job.report});
    for (const Surface& surface : job.surfaces) outputs.push_back({surface.option(), surface.path});
  }
  if (arguments.dry_run) outputs.push_back({"--dry-run", "-"});
  inputs.add(arguments.values);
  inputs.add(arguments.vertex_weights);
  inputs.add(arguments.weights);
  require_separate(inputs, outputs, arguments, session);
}

/// Warns about outputs that were asked for and will not be written.
void explain_unwritten(const Arguments& arguments, BarcodeFormat format, app::Session& session) {
  std::vector<std::string> unwritten, estimated;
  const bool is_named = arguments.output != "-";
  if (is_named && (arguments.dry_run || format == BarcodeFormat::none))
    unwritten.push_back("--output " + arguments.output);
  if (arguments.dry_run) {
    for (const app::Plot& plot : arguments.plots)
      unwritten.push_back(plot.option + " " + plot.path);
    if (!arguments.report.empty()) unwritten.push_back("--report " + arguments.report);
    for (const Surface& surface : arguments.surfaces)
      unwritten.push_back(fmt::format("{} {}", surface.option(), surface.path));
    if (arguments.check) unwritten.emplace_back("--check");
    const Options& options = arguments.options;
    if (options.min_persistence > 0) unwritten.emplace_back("--min-persistence");
    if (arguments.loops) unwritten.emplace_back("--loops");
    // The memory of bars depends on these, for example on the cells that JSON needs.
    if (arguments.output_format)
      estimated.push_back(fmt::format("--output-format {}", barcode_format_name(format)));
    if (options.min_dim > 0) estimated.emplace_back("--min-dim");
    if (options.field != 2) estimated.emplace_back("--field");
    if (options.representatives != Representatives::none)
      estimated.emplace_back("--representatives");
  }
  if (!unwritten.empty())
    session.note(fmt::format("{}: nothing is done for {}",
                             arguments.dry_run ? "--dry-run" : "--output-format none",
                             fmt::join(unwritten, ", ")));
  if (!estimated.empty())
    session.note(fmt::format("--dry-run: nothing is done for {} except to estimate memory",
                             fmt::join(estimated, ", ")));
}

/// Options for bars that have no effect if only the merge tree is written.
void explain_unseen_bars(const Arguments& arguments, BarcodeFormat format, app::Session& session) {
  const bool is_seen = format != BarcodeFormat::none || !arguments.report.empty() ||
                       arguments.check ||
                       std::ranges::any_of(arguments.plots, &app::Plot::shows_bars);
  if (is_seen || !arguments.draws_tree() || arguments.dry_run) return;
  constexpr std::array<std::string_view, 5> kOfBars{"min-persistence", "max-dim", "min-dim",
                                                    "field", "engine"};
  std::vector<std::string> given;
  for (const app::GivenOption& option : arguments.given)
    if (std::ranges::find(kOfBars, option.name) != kOfBars.end())
      given.push_back(fmt::format("--{}", option.name));
  if (!given.empty())
    session.note(fmt::format("nothing is done for {}: only the merge tree is written",
                             fmt::join(given, ", ")));
}

/// Runs one of several inputs and writes one line to stderr, whatever the outcome. @return the exit
/// code.
/// @throws Error if the other inputs need not be tried.
int run_one(const Job& job, const Arguments& arguments, app::Session& session) {
  try {
    const Outcome outcome = run(job, arguments, session);
    session.note(fmt::format("{}: {}", job.input, outcome.summary));
    return outcome.code;
  } catch (const BrokenPipe&) {
    throw;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    const bool named = error.message().is_about(printable(job.input));
    return app::report_current_exception(kProgram, named ? "" : job.input);
  } catch (...) {
    return app::report_current_exception(kProgram, job.input);
  }
}

}  // namespace

BarcodeFormat output_format(const Arguments& arguments, app::Session& session) {
  if (arguments.output_format) return *arguments.output_format;
  if (const app::Plot picture{.path = arguments.output, .kind = {}};
      picture.is_svg() || picture.is_png())
    throw Error(ErrorKind::usage,
                fmt::format("--output: found '{0}', expected a barcode; --plot {0} draws it, "
                            "--output-format says what else it is",
                            printable(arguments.output)));
  // Pictures of several inputs do not need barcodes beside them.
  const bool has_others =
      !arguments.plots.empty() || !arguments.report.empty() || !arguments.surfaces.empty();
  if (arguments.is_batch() && arguments.output == "-" && has_others) return BarcodeFormat::none;
  if (arguments.is_batch() &&
      (arguments.output.ends_with('/') || !app::names_each(arguments.output)))
    return BarcodeFormat::csv;
  if (const auto format = barcode_format_of_path(arguments.output)) return *format;
  require_unpacked(arguments.output);
  if (app::has_extension(arguments.output))
    session.note(app::no_format_in(arguments.output, "csv"));
  return BarcodeFormat::csv;
}

int run_all(const Arguments& given, app::Session& session) {
  for (const std::string& note : given.notes) session.note(note);
  if (!given.compare.empty()) {
    app::require_in_scope(given.given, kComparison, name_of(kComparison));
    app::InputFiles inputs;
    for (const std::string& path : given.compare) inputs.add(path);
    std::vector<app::Written> outputs;
    const BarcodeFormat format = given.output_format.value_or(BarcodeFormat::csv);
    // mutant: compare-output
    if (format != BarcodeFormat::none) outputs.push_back({"--output", given.output});
    if (!given.report.empty()) outputs.push_back({"--report", given.report});
    require_separate(inputs, outputs, given, session);
    explain_unwritten(given, format, session);
    return run_comparison(given, session);
  }
  if (given.part) return run_part(given, session);
  if (given.joins && is_part_path(given.output))
    return run_join(given, BarcodeFormat::none, session);
  const BarcodeFormat format = output_format(given, session);
  if (given.joins) return run_join(given, format, session);
  Arguments arguments = given;
  // JSON and the report show cells.
  arguments.options.cells = format == BarcodeFormat::json || !arguments.report.empty();
  require_room(format, arguments);
  const std::vector<std::string> inputs =
      arguments.is_batch() ? with_files_of_folders(arguments) : arguments.inputs;
  const std::vector<Job> jobs = jobs_of(arguments, inputs, format);
  require_separate(jobs, arguments, session);
  explain_unwritten(arguments, format, session);
  explain_unseen_bars(arguments, format, session);
  if (!arguments.is_batch()) return run(jobs[0], arguments, session).code;
  if (!arguments.dry_run) prepare_folders(arguments, format);

  int first_failure = app::kOk;
  std::size_t failures = 0;
  for (const Job& job : jobs) {
    const int code = run_one(job, arguments, session);
    if (code == app::kOk) continue;
    if (first_failure == app::kOk) first_failure = code;
    ++failures;
  }
  if (failures > 0) session.note(fmt::format("{} of {} inputs failed", failures, jobs.size()));
  return first_failure;
}

}  // namespace ph::barcode
