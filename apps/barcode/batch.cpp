// SPDX-License-Identifier: MIT
#include "batch.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <string_view>
#include <system_error>

#include "exit_code.hpp"
#include "program.hpp"
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

/// Only JSON has room for representatives. @throws Error (usage).
void require_room(BarcodeFormat format, const Arguments& arguments) {
  if (arguments.options.representatives == Representatives::none || arguments.dry_run) return;
  if (format == BarcodeFormat::json || format == BarcodeFormat::none) return;
  throw Error(ErrorKind::usage,
              fmt::format("--representatives: found output format {}, expected json; "
                          "--output-format json or -o FILE.json holds them",
                          barcode_format_name(format)));
}

std::string file_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string name = slash == path.npos ? path : path.substr(slash + 1);
  return name == "-" ? "stdin" : name;
}

std::string stem(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos || dot == 0 ? name : name.substr(0, dot);
}

/// The file name behind the names of its folders: "monday/../run/a.txt" is "monday-run-a.txt".
std::string name_with_folders(const std::string& path) {
  std::string joined;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    if (!part.empty() && part != "." && part != "..") joined += (joined.empty() ? "" : "-") + part;
    begin = end + 1;
  }
  return joined == "-" ? file_name(path) : joined;
}

/// Names for the outputs of inputs: the shortest that only one of them has, without extension, with
/// it, or with folders.
std::vector<std::string> output_names(const std::vector<std::string>& inputs) {
  std::map<std::string, int> stems, names;
  for (const std::string& input : inputs) {
    ++stems[stem(file_name(input))];
    ++names[file_name(input)];
  }
  std::vector<std::string> result;
  for (const std::string& input : inputs) {
    const std::string name = file_name(input), short_name = stem(name);
    result.push_back(stems[short_name] == 1 ? short_name
                     : names[name] == 1     ? name
                                            : name_with_folders(input));
  }
  return result;
}

/// One job an input.
std::vector<Job> jobs_of(const Arguments& arguments, BarcodeFormat format) {
  std::vector<Job> jobs;
  if (!arguments.is_batch() || format == BarcodeFormat::none) {
    for (const std::string& input : arguments.inputs)
      jobs.push_back({input, arguments.output, format});
    return jobs;
  }
  const std::vector<std::string> names = output_names(arguments.inputs);
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

void create_folder(const std::string& path) {
  if (mkdir(path.c_str(), 0777) == 0) return;
  const int error = errno;
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return;
  throw Error(ErrorKind::cannot_create,
              fmt::format("{}: cannot create the folder: {}", path,
                          std::error_code(error, std::generic_category()).message()));
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
    return app::report_current_exception(named ? "ph-barcode" : "ph-barcode: " + job.input);
  } catch (...) {
    return app::report_current_exception("ph-barcode: " + job.input);
  }
}

}  // namespace

int run_all(const Arguments& arguments, app::Session& session) {
  const BarcodeFormat format = format_of(arguments, session);
  require_room(format, arguments);
  const std::vector<Job> jobs = jobs_of(arguments, format);
  if (jobs.size() == 1 && !arguments.is_batch()) return run(jobs[0], arguments, session).code;

  if (arguments.is_batch() && !arguments.dry_run && format != BarcodeFormat::none)
    create_folder(arguments.output);
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
