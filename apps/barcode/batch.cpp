// SPDX-License-Identifier: MIT
#include "batch.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>

#include "batch_names.hpp"
#include "exit_code.hpp"
#include "program.hpp"
#include "report.hpp"
#include "run.hpp"

namespace ph::barcode {
namespace {

BarcodeFormat format_of(const Arguments& arguments, app::Session& session) {
  if (arguments.output_format) return *arguments.output_format;
  if (arguments.is_batch()) return BarcodeFormat::csv;
  if (const auto format = barcode_format_of_path(arguments.output)) return *format;
  const std::string& path = arguments.output;
  const std::size_t name = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
  // A leading dot hides a file; it starts no extension.
  if (path.find('.', name + 1) != path.npos && !path.ends_with(".."))
    session.note(fmt::format("{}: the extension names no format, writing csv", path));
  return BarcodeFormat::csv;
}

/// Only JSON and the report have room for representatives, and only JSON for loops.
/// @throws Error (usage).
void require_room(BarcodeFormat format, const Arguments& arguments) {
  if (arguments.options.representatives == Representatives::none || arguments.dry_run) return;
  if (arguments.loops && format != BarcodeFormat::json)
    throw Error(
        ErrorKind::usage,
        fmt::format("--loops: found output format {}, expected json; --output-format json or "
                    "-o FILE.json holds them",
                    barcode_format_name(format)));
  if (!arguments.report.empty()) return;
  if (format == BarcodeFormat::json || format == BarcodeFormat::none) return;
  throw Error(ErrorKind::usage,
              fmt::format("--representatives: found output format {}, expected json; "
                          "--output-format json or -o FILE.json holds them",
                          barcode_format_name(format)));
}

/// One job an input.
std::vector<Job> jobs_of(const Arguments& arguments, BarcodeFormat format) {
  std::vector<Job> jobs;
  if (!arguments.is_batch() || format == BarcodeFormat::none) {
    for (const std::string& input : arguments.inputs)
      jobs.push_back({input, arguments.output, format});
    return jobs;
  }
  const std::vector<std::string> names = app::output_names(arguments.inputs);
  std::map<std::string, std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& input = arguments.inputs[i];
    const std::string output =
        fmt::format("{}{}{}.{}", arguments.output, arguments.output.ends_with('/') ? "" : "/",
                    names[i], barcode_format_name(format));
    const auto [other, fresh] = taken.emplace(output, input);
    if (!fresh)
      throw Error(ErrorKind::usage, fmt::format("--output: {} and {} would both be written to {}",
                                                other->second, input, output));
    jobs.push_back({input, output, format});
  }
  return jobs;
}

/// One input of several: a line on stderr, whatever becomes of it. @return the exit code.
/// @throws Error if the others need not be tried.
int run_one(const Job& job, const Arguments& arguments, app::Session& session) {
  try {
    const Outcome outcome = run(job, arguments, session);
    session.note(fmt::format("{}: {}", job.input, outcome.summary));
    return outcome.code;
  } catch (const BrokenPipe&) {
    throw;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    const bool named = std::string_view(error.what()).find(job.input) != std::string_view::npos;
    return app::report_current_exception(kProgram, named ? "" : job.input);
  } catch (...) {
    return app::report_current_exception(kProgram, job.input);
  }
}

}  // namespace

int run_all(const Arguments& given, app::Session& session) {
  if (!given.compare.empty()) return run_comparison(given, session);
  const BarcodeFormat format = format_of(given, session);
  Arguments arguments = given;
  // JSON and the report show them.
  arguments.options.cells = format == BarcodeFormat::json || !arguments.report.empty();
  require_room(format, arguments);
  const std::vector<Job> jobs = jobs_of(arguments, format);
  if (jobs.size() == 1 && !arguments.is_batch()) return run(jobs[0], arguments, session).code;

  if (arguments.is_batch() && !arguments.dry_run && format != BarcodeFormat::none)
    app::create_folder(arguments.output);
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
