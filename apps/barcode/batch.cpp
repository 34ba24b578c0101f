// SPDX-License-Identifier: MIT
#include "batch.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <map>
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

/// One job an input. Names keep the extension of the input where two would be the same without it.
std::vector<Job> jobs_of(const Arguments& arguments, BarcodeFormat format) {
  if (!arguments.is_batch() || format == BarcodeFormat::none) {
    std::vector<Job> jobs;
    for (const std::string& input : arguments.inputs)
      jobs.push_back({input, arguments.output, format});
    return jobs;
  }
  std::map<std::string, int> uses;
  for (const std::string& input : arguments.inputs) ++uses[stem(file_name(input))];
  std::map<std::string, std::string> taken;
  std::vector<Job> jobs;
  for (const std::string& input : arguments.inputs) {
    const std::string name = file_name(input), short_name = stem(name);
    const std::string output =
        fmt::format("{}{}{}.{}", arguments.output, arguments.output.ends_with('/') ? "" : "/",
                    uses[short_name] > 1 ? name : short_name, barcode_format_name(format));
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

}  // namespace

int run_all(const Arguments& arguments, app::Session& session) {
  const BarcodeFormat format = format_of(arguments, session);
  require_room(format, arguments);
  const std::vector<Job> jobs = jobs_of(arguments, format);
  if (jobs.size() == 1 && !arguments.is_batch()) return run(jobs[0], arguments, session).code;

  if (arguments.is_batch() && !arguments.dry_run && format != BarcodeFormat::none)
    create_folder(arguments.output);
  int first_failure = app::kOk;
  for (const Job& job : jobs) {
    int code = app::kOk;
    try {
      const Outcome outcome = run(job, arguments, session);
      code = outcome.code;
      session.note(fmt::format("{}: {}", job.input, outcome.summary));
    } catch (const BrokenPipe&) {
      throw;
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cancelled) throw;
      code = app::report_current_exception("ph-barcode");
    } catch (...) {
      code = app::report_current_exception("ph-barcode: " + job.input);
    }
    if (first_failure == app::kOk) first_failure = code;
  }
  return first_failure;
}

}  // namespace ph::barcode
