// SPDX-License-Identifier: MIT
#include "apps/barcode/parts/cloud_parts.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/memory/forecast_text.hpp"
#include "apps/common/files/batch_names.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {

Barcode bars_of(CloudPart whole, BarcodeFormat format, const RunContext& context) {
  if (format != BarcodeFormat::json) return whole.barcode(context);
  return persistence(std::move(whole).rips(context), {.max_dim = 0}, context);
}

Outcome foresee(const CloudInput& cloud, int parts, std::string_view process) {
  const CloudPartForecast forecast = CloudPart::forecast(cloud.points, parts, cloud.options);
  write_file("-", forecast_text(forecast, cloud.data.read.description, parts, process));
  return {app::kOk, cloud.data.read.description};
}

Outcome run_cloud_part(const std::string& input, const Job& job, app::Session& session) {
  app::require_in_scope(job.given, kCloudPart, name_of(kCloudPart));
  const auto [part, parts] = *job.sharing.part;
  const std::string path =
      part_path(job.places.output, app::output_names({input}).front(), part, parts);
  const CloudInput cloud = read_cloud_input(input, job, session);
  if (job.results.dry_run) return foresee(cloud, parts, "");
  if (job.sharing.resumes && kept_cloud_part(path, cloud, part, parts, session))
    return {app::kOk, fmt::format("{} already exists", path)};
  app::InputFiles inputs;
  inputs.add(input);
  app::require_separate(inputs, std::array{app::Written{"--output", path}}, job.common.force);
  app::Output output(path);
  const CloudPart made(cloud.points, part, parts, cloud.options, session.context());
  session.explain("memory " + format_size(static_cast<double>(session.memory_taken())));
  const app::BarHold results_are_written(session);
  return {app::kOk, fmt::format("{}, part {} of {}: {}", cloud.data.read.description, part + 1,
                                parts, write_part_file(output, made.bytes()))};
}

Outcome join_cloud_parts(const std::vector<PartFile>& files, const Job& job,
                         app::Session& session) {
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
      throw Error(error.kind(), fmt::format("{}: {}", file.path, error.marked()));
    }
  }
  const std::string words = fmt::format("{} of {} parts", all->present().size(), all->parts());
  if (is_part_path(job.places.output)) {
    app::Output output(job.places.output);
    return {app::kOk, fmt::format("{}: {}", words, write_part_file(output, all->bytes()))};
  }
  if (!all->is_whole())
    throw Error(
        ErrorKind::bad_data,
        fmt::format("--join: found {}, expected all (first missing: part {}); -o FILE.ph joins "
                    "those given",
                    words, all->missing().front() + 1));
  Outputs outputs(job.places);
  const BarcodeInfo info = named(
      all->info(),
      fmt::format("{} points, {}", all->points(), app::count_of(files.size(), "part file")), job);
  return write_bars(bars_of(std::move(*all), job.places.format, context), info, outputs, job,
                    session);
}

}  // namespace ph::barcode
