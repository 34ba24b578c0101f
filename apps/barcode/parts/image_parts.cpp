// SPDX-License-Identifier: MIT
#include "apps/barcode/parts/image_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/memory/forecast_text.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "apps/barcode/parts/part_input.hpp"
#include "apps/common/files/batch_names.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {
namespace {

/// Returns words such as "part 3 of 8" or "parts 2 to 4 of 8".
std::string words_of(const ImagePart& part) {
  if (part.first() == part.last())
    return fmt::format("part {} of {}", part.first() + 1, part.parts());
  return fmt::format("parts {} to {} of {}", part.first() + 1, part.last() + 1, part.parts());
}

ImagePart of_file(const PartFile& file, const RunContext& context) {
  try {
    return ImagePart::of_bytes(file.bytes, context);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", file.path, error.marked()));
  }
}

/// Joins parts. Errors about parts that do not belong together name the files of these parts.
void join(ImagePart& all, ImagePart next, const std::string& before, const std::string& path,
          const RunContext& context) {
  try {
    all.join(std::move(next), context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    throw Error(error.kind(), fmt::format("{}: {}; joined with {}", path, error.marked(), before));
  }
}

}  // namespace

std::optional<ImagePart> kept_image_part(const std::string& path, const PartInput& image, int part,
                                         int parts, app::Session& session) {
  return kept_part(
      path, session,
      [&](std::span<const std::byte> bytes) {
        return ImagePart::of_bytes(bytes, session.context());
      },
      [&](const ImagePart& kept) {
        return kept.is_of(image.image, part, parts, image.options)
                   ? ""
                   : "is not the requested part for this input and these options";
      });
}

Outcome foresee(const PartInput& read, int parts, std::string_view process) {
  const ImagePartForecast forecast = ImagePart::forecast(read.image, parts, read.options);
  write_file("-", forecast_text(forecast, read.description, parts, process));
  return {app::kOk, read.description};
}

Outcome run_image_part(const std::string& input, const Job& job, app::Session& session) {
  const auto [part, parts] = *job.sharing.part;
  const std::string path =
      part_path(job.places.output, app::output_names({input}).front(), part, parts);
  app::require_in_scope(job.given, kImagePart, name_of(kImagePart));
  const PartInput read = read_part_input(input, job.sharing.keeps_cells, job, session);
  if (job.results.dry_run) return foresee(read, parts, "");
  if (job.sharing.resumes && kept_image_part(path, read, part, parts, session))
    return {app::kOk, fmt::format("{} already exists", path)};
  app::InputFiles inputs;
  inputs.add(input, job.reading.format);
  app::require_separate(inputs, std::array{app::Written{"--output", path}}, job.common.force);
  app::Output output(path);
  const ImagePart made = [&] {
    try {
      return ImagePart(read.image, part, parts, read.options, session.context());
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::usage) throw;
      throw Error(error.kind(), fmt::format("--part: {}", error.marked()));
    }
  }();
  session.explain("memory " + format_size(static_cast<double>(session.memory_taken())));
  const app::BarHold results_are_written(session);
  return {app::kOk, fmt::format("{}, {}: {}", read.description, words_of(made),
                                write_part_file(output, made.bytes()))};
}

Outcome join_image_parts(std::vector<PartFile> files, const Job& job, app::Session& session) {
  const RunContext& context = session.context();
  std::vector<std::pair<ImagePart, std::string>> parts;
  for (PartFile& file : files) {
    parts.emplace_back(of_file(file, context), file.path);
    file.bytes = {};
  }
  std::ranges::stable_sort(parts, {}, [](const auto& part) { return part.first.first(); });
  ImagePart all = std::move(parts.front().first);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    auto& [next, path] = parts[i];
    const std::string& before = parts[i - 1].second;
    if (next.parts() == all.parts() && next.first() <= all.last())
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found {}, also in {}, expected each part once", path,
                              words_of(next), before));
    join(all, std::move(next), before, path, context);
  }
  if (is_part_path(job.places.output)) {
    app::Output output(job.places.output);
    return {app::kOk, fmt::format("{}: {}", words_of(all), write_part_file(output, all.bytes()))};
  }
  if (!all.is_whole())
    throw Error(
        ErrorKind::bad_data,
        fmt::format("--join: found {}, expected all; -o FILE.ph joins those given", words_of(all)));
  if (job.places.format == BarcodeFormat::json && !all.options().cells)
    throw Error(ErrorKind::usage,
                "--output-format: found json, which needs the cells of bars; --part with "
                "--keep-cells stores the cells");
  Outputs outputs(job.places);
  Barcode bars = all.barcode(context);
  const BarcodeInfo info = named(bars.info(),
                                 fmt::format("image {}, {}", fmt::join(all.extents(), " x "),
                                             app::count_of(parts.size(), "part file")),
                                 job);
  return write_bars(std::move(bars), info, outputs, job, session);
}

}  // namespace ph::barcode
