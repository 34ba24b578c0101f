// SPDX-License-Identifier: MIT
#include "barcode/parts/cloud_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <optional>
#include <utility>

#include "barcode/arguments/option_scopes.hpp"
#include "barcode/complex/read_input.hpp"
#include "common/arguments/numbers.hpp"
#include "common/files/batch_names.hpp"
#include "common/files/file_identity.hpp"
#include "common/system/process.hpp"
#include "common/terminal/exit_code.hpp"
#include "core/system/files.hpp"
#include "ph/parts/cloud_part.hpp"

namespace ph::barcode {
namespace {

/// Whether the output is that part already. A file that is another is computed anew.
bool is_there(const std::string& path, const std::string& input, PointsView points,
              const CloudPartOptions& options, const Arguments& arguments, app::Session& session) {
  const auto [part, parts] = *arguments.part;
  const auto kept = kept_part(
      path, std::span(&input, 1), session,
      [&](std::span<const std::byte> bytes) {
        return CloudPart::of_bytes(bytes, session.context());
      },
      [&, number = part, of = parts](const CloudPart& there) {
        return there.is_of(points, number, of, options) ? "" : "is another part";
      });
  return kept.has_value();
}

}  // namespace

Outcome run_cloud_part(const std::string& input, const Arguments& arguments,
                       app::Session& session) {
  app::require_in_scope(arguments.given, kCloudPart, name_of(kCloudPart));
  if (arguments.options.max_dim != 0)
    throw Error(ErrorKind::usage,
                "--part with --complex rips: there are components alone, expected --max-dim 0");
  if (arguments.rips.distance != PointDistance::euclidean)
    throw Error(ErrorKind::usage, "--metric: found another one, expected euclidean with --part");
  const auto [part, parts] = *arguments.part;
  const std::string path =
      part_path(arguments.output, app::output_names({input}).front(), part, parts);
  const NamedData data = read_input(Input::open(files::path_of(input), &session.context()),
                                    arguments, session.context());
  const std::string& description = data.read.description;
  const std::optional<PointsView> points = points_of(data.read);
  if (!points)
    throw Error(ErrorKind::usage, fmt::format("--part: found {}, expected points", description));
  session.explain(fmt::format("read {}: {}", data.name, description));
  for (const std::string& note : data.read.notes)
    session.note(fmt::format("{}: {}", data.name, note));
  const CloudPartOptions options{.threshold = arguments.threshold,
                                 .distance = arguments.rips.distance};
  if (arguments.resumes && is_there(path, input, *points, options, arguments, session))
    return {app::kOk, fmt::format("{}: it is there already", path)};
  app::InputFiles inputs;
  inputs.add(input);
  app::require_separate(inputs, std::array{app::Written{"--output", path}}, arguments.common.force);
  app::Output output(path);
  const CloudPart made(*points, part, parts, options, session.context());
  session.explain("memory " + app::format_size(static_cast<double>(session.memory_taken())));
  const app::BarHold results_are_written(session);
  return {app::kOk, fmt::format("{}, part {} of {}: {}", description, part + 1, parts,
                                write_part_file(output, made.bytes()))};
}

Outcome join_cloud_parts(const std::vector<PartFile>& files, const Job& job,
                         const Arguments& arguments, app::Session& session) {
  const RunContext& context = session.context();
  std::optional<CloudPart> all;
  for (const PartFile& file : files) {
    try {
      CloudPart part = CloudPart::of_bytes(file.bytes, context);
      if (all)
        all->join(std::move(part), context);
      else
        all.emplace(std::move(part));
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::bad_data) throw;
      throw Error(error.kind(), fmt::format("{}: {}", file.path, error.what()));
    }
  }
  const std::vector<int> missing = all->missing();
  const std::string words = fmt::format(
      "{} of {} parts", static_cast<std::size_t>(all->parts()) - missing.size(), all->parts());
  if (is_part_path(job.output)) {
    app::Output output(job.output);
    return {app::kOk, fmt::format("{}: {}", words, write_part_file(output, all->bytes()))};
  }
  if (!missing.empty())
    throw Error(ErrorKind::bad_data,
                fmt::format("--join: found {}, expected all: missing is part {}; -o FILE.ph joins "
                            "some",
                            words, missing.front() + 1));
  Outputs outputs(job);
  BarcodeInfo info;
  info.program = app::program_and_version("ph-barcode");
  info.input = job.input;
  info.input_description =
      fmt::format("{} points, {}", all->points(), app::count_of(files.size(), "part file"));
  info.complex = "rips";
  info.threshold = all->threshold();
  info.engine = Engine(Engine::union_find).name();
  info.peak_memory = app::peak_memory();
  // JSON shows cells, which the forest as a complex has.
  Barcode bars = job.format == BarcodeFormat::json
                     ? persistence(std::move(*all).rips(context), {.max_dim = 0}, context)
                     : all->barcode(context);
  return write_bars(std::move(bars), info, outputs, arguments, session);
}

}  // namespace ph::barcode
