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
#include "ph/detail/io/table.hpp"

namespace ph::barcode {
namespace {

/// Refuses a format that has no room for the requested results. Only JSON and the report can
/// contain representatives, and only JSON can contain loops. CSV has the places of cycles and of
/// sets of voxels.
/// @throws Error (usage).
void require_room(BarcodeFormat format, const Job& job) {
  if (!job.results.dry_run) require_significance(format, job);
  const Representatives kind = job.question.options.representatives;
  if (kind == Representatives::none || job.results.dry_run) return;
  if (job.results.loops && format != BarcodeFormat::json)
    throw Error(ErrorKind::usage, fmt::format("--loops: found output format {}, expected json; use "
                                              "--output-format json or -o FILE.json",
                                              barcode_format_name(format)));
  if (!job.places.report.empty() || format == BarcodeFormat::json) return;
  const bool has_places = kind != Representatives::cocycles;
  if (has_places && format == BarcodeFormat::csv) return;
  throw Error(
      ErrorKind::usage,
      fmt::format("--representatives: found output format {}, expected json{}; use "
                  "--output-format json or -o FILE.json",
                  barcode_format_name(format), has_places ? ", or csv for a table of places" : ""));
}

/// The input and the output files of one of several inputs. The folders and patterns of the job
/// determine the files.
Places places_of(const std::string& input, const std::string& name, const Job& job,
                 BarcodeFormat format) {
  Places places = job.places;
  places.input = input;
  places.format = format;
  if (format != BarcodeFormat::none)
    places.output =
        app::filled(places.output, name, fmt::format(".{}", barcode_format_name(format)));
  for (app::Plot& plot : places.plots) plot.path = app::filled(plot.path, name, ".svg");
  places.report = app::filled(places.report, name, ".html");
  for (Surface& surface : places.surfaces) surface.path = app::filled(surface.path, name, ".ply");
  return places;
}

/// For each input of the job, the input and its output files.
std::vector<Places> places_of(const Job& job, const std::vector<std::string>& inputs,
                              BarcodeFormat format) {
  if (!job.is_batch()) {
    Places places = job.places;
    places.input = inputs.front();
    places.format = format;
    return {places};
  }
  const std::string& output = job.places.output;
  const bool is_place = app::names_each(output) || (output != "-" && app::is_folder(output));
  if (format != BarcodeFormat::none && !is_place && !job.results.dry_run)
    throw Error(
        ErrorKind::usage,
        fmt::format("--output: found '{}', expected a folder (-o FOLDER/) or a * for the names of "
                    "several inputs{}",
                    output,
                    std::ranges::all_of(inputs, detail::may_be_slice)
                        ? "; --stack FOLDER reads the pictures in a folder as one volume"
                        : ""));
  const std::vector<std::string> names = app::output_names(inputs);
  const bool writes = format != BarcodeFormat::none || !job.places.plots.empty() ||
                      !job.places.report.empty() || !job.places.surfaces.empty();
  std::map<std::string, std::string> taken;
  std::vector<Places> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [other, fresh] = taken.emplace(names[i], inputs[i]);
    all.push_back(places_of(inputs[i], names[i], job, format));
    if (!fresh && writes && !job.results.dry_run)
      throw Error(ErrorKind::usage, fmt::format("--output: {} and {} would both be written to {}",
                                                other->second, inputs[i], all.back().output));
  }
  return all;
}

/// Creates the folders of a batch.
void prepare_folders(const Job& job, BarcodeFormat format) {
  if (format != BarcodeFormat::none) app::prepare_outputs("--output", job.places.output);
  for (const app::Plot& plot : job.places.plots) app::prepare_outputs(plot.option, plot.path);
  app::prepare_outputs("--report", job.places.report);
  for (const Surface& surface : job.places.surfaces)
    app::prepare_outputs(surface.option(), surface.path);
}

/// Checks that no output replaces an input or another output. @throws Error (usage).
void require_separate(const app::InputFiles& inputs, const std::vector<app::Written>& outputs,
                      const Job& job, app::Session& session) {
  const bool replaces = app::require_separate(inputs, outputs, job.common.force);
  if (!job.common.force || replaces) return;
  if (job.results.dry_run)
    session.note("--force does nothing: --dry-run writes no file");
  else
    session.explain("--force: not needed, because no output is an input");
}
void require_separate(const std::vector<Places>& all, const Job& job, app::Session& session) {
  app::InputFiles inputs;
  std::vector<app::Written> outputs;
  for (const Places& places : all) {
    inputs.add(places.input, job.reading.format);
    if (job.results.dry_run) continue;
    if (places.format != BarcodeFormat::none) outputs.push_back({"--output", places.output});
    for (const app::Plot& plot : places.plots) outputs.push_back({plot.option, plot.path});
    if (!places.report.empty()) outputs.push_back({"--report", places.report});
    for (const Surface& surface : places.surfaces)
      outputs.push_back({surface.option(), surface.path});
  }
  if (job.results.dry_run) outputs.push_back({"--dry-run", "-"});
  inputs.add(job.reading.values);
  inputs.add(job.question.vertex_weights);
  inputs.add(job.question.weights);
  require_separate(inputs, outputs, job, session);
}

/// Warns about outputs that were requested but will not be written.
void explain_unwritten(const Job& job, BarcodeFormat format, app::Session& session) {
  std::vector<std::string> unwritten, estimated;
  const bool is_named = job.places.output != "-";
  if (is_named && (job.results.dry_run || format == BarcodeFormat::none))
    unwritten.push_back("--output " + job.places.output);
  if (job.results.dry_run) {
    for (const app::Plot& plot : job.places.plots)
      unwritten.push_back(plot.option + " " + plot.path);
    if (!job.places.report.empty()) unwritten.push_back("--report " + job.places.report);
    for (const Surface& surface : job.places.surfaces)
      unwritten.push_back(fmt::format("{} {}", surface.option(), surface.path));
    if (job.results.check) unwritten.emplace_back("--check");
    const Options& options = job.question.options;
    if (options.min_persistence > 0) unwritten.emplace_back("--min-persistence");
    if (job.results.loops) unwritten.emplace_back("--loops");
    // These options affect how much memory bars need. For example, JSON needs the cells of bars.
    if (job.results.output_format)
      estimated.push_back(fmt::format("--output-format {}", barcode_format_name(format)));
    if (options.min_dim > 0) estimated.emplace_back("--min-dim");
    if (options.field != 2) estimated.emplace_back("--field");
    if (options.representatives != Representatives::none)
      estimated.emplace_back("--representatives");
  }
  if (!unwritten.empty())
    session.note(fmt::format("{} ignores {}",
                             job.results.dry_run ? "--dry-run" : "--output-format none",
                             fmt::join(unwritten, ", ")));
  if (!estimated.empty())
    session.note(
        fmt::format("--dry-run uses {} only to estimate memory", fmt::join(estimated, ", ")));
}

/// Notes which of the given options for bars have no effect, because only the merge tree is
/// written.
void explain_unseen_bars(const Job& job, BarcodeFormat format, app::Session& session) {
  const bool is_seen = format != BarcodeFormat::none || !job.places.report.empty() ||
                       job.results.check ||
                       std::ranges::any_of(job.places.plots, &app::Plot::shows_bars);
  if (is_seen || !job.draws_tree() || job.results.dry_run) return;
  constexpr std::array<std::string_view, 5> kOfBars{"min-persistence", "max-dim", "min-dim",
                                                    "field", "engine"};
  std::vector<std::string> given;
  for (const app::GivenOption& option : job.given)
    if (std::ranges::find(kOfBars, option.name) != kOfBars.end())
      given.push_back(fmt::format("--{}", option.name));
  if (!given.empty())
    session.note(
        fmt::format("{}: ignored, because only the merge tree is written", fmt::join(given, ", ")));
}

/// Processes one of several inputs, and writes one line to stderr for any outcome. @return the exit
/// code.
/// @throws Error if the other inputs need not be tried.
int run_one(const Job& job, app::Session& session) {
  try {
    const Outcome outcome = run(job, session);
    session.note(fmt::format("{}: {}", job.places.input, outcome.summary));
    return outcome.code;
  } catch (const BrokenPipe&) {
    throw;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    const bool named = error.message().is_about(printable(job.places.input));
    return app::report_current_exception(kProgram, named ? "" : job.places.input);
  } catch (...) {
    return app::report_current_exception(kProgram, job.places.input);
  }
}

}  // namespace

BarcodeFormat output_format(const Job& job, app::Session& session) {
  if (job.results.output_format) return *job.results.output_format;
  if (const app::Plot picture{.path = job.places.output, .kind = {}};
      picture.is_svg() || picture.is_png())
    throw Error(
        ErrorKind::usage,
        fmt::format("--output: found '{0}', expected the name of a barcode file; --plot {0} draws "
                    "the barcode, --output-format NAME writes it there in another format",
                    printable(job.places.output)));
  // If only pictures, reports or surfaces are written for several inputs, their barcodes are not
  // printed in addition.
  const bool has_others =
      !job.places.plots.empty() || !job.places.report.empty() || !job.places.surfaces.empty();
  if (job.is_batch() && job.places.output == "-" && has_others) return BarcodeFormat::none;
  if (job.is_batch() && (job.places.output.ends_with('/') || !app::names_each(job.places.output)))
    return BarcodeFormat::csv;
  if (const auto format = barcode_format_of_path(job.places.output)) return *format;
  require_unpacked(job.places.output);
  if (app::has_extension(job.places.output))
    session.note(app::no_format_in(job.places.output, "csv"));
  return BarcodeFormat::csv;
}

int run_all(const Job& given, app::Session& session) {
  for (const std::string& note : given.notes) session.note(note);
  if (!given.compare.empty()) {
    app::require_in_scope(given.given, kComparison, name_of(kComparison));
    app::InputFiles inputs;
    for (const std::string& path : given.compare) inputs.add(path);
    std::vector<app::Written> outputs;
    const BarcodeFormat format = given.results.output_format.value_or(BarcodeFormat::csv);
    // mutant: compare-output
    if (format != BarcodeFormat::none) outputs.push_back({"--output", given.places.output});
    if (!given.places.report.empty()) outputs.push_back({"--report", given.places.report});
    require_separate(inputs, outputs, given, session);
    explain_unwritten(given, format, session);
    return run_comparison(given, session);
  }
  if (given.sharing.part) return run_part(given, session);
  if (given.sharing.joins && is_part_path(given.places.output))
    return run_join(given, BarcodeFormat::none, session);
  const BarcodeFormat format = output_format(given, session);
  if (given.sharing.joins) return run_join(given, format, session);
  Job job = given;
  // JSON and the report show cells.
  job.question.options.cells = format == BarcodeFormat::json || !job.places.report.empty();
  require_room(format, job);
  const std::vector<std::string> inputs =
      job.is_batch() ? inputs_of_batch(job, session) : job.inputs;
  std::vector<Places> all = places_of(job, inputs, format);
  require_separate(all, job, session);
  explain_unwritten(job, format, session);
  explain_unseen_bars(job, format, session);
  job.of_batch = job.is_batch();
  if (job.of_batch && !job.results.dry_run) prepare_folders(job, format);
  if (!job.of_batch) {
    job.places = std::move(all[0]);
    return run(job, session).code;
  }

  int first_failure = app::kOk;
  std::size_t failures = 0;
  for (Places& places : all) {
    job.places = std::move(places);
    const int code = run_one(job, session);
    if (code == app::kOk) continue;
    if (first_failure == app::kOk) first_failure = code;
    ++failures;
  }
  if (failures > 0) session.note(fmt::format("{} of {} inputs failed", failures, all.size()));
  return first_failure;
}

}  // namespace ph::barcode
