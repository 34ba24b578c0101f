// SPDX-License-Identifier: MIT
#include "barcode/parts/image_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "barcode/arguments/option_scopes.hpp"
#include "barcode/complex/build_complex.hpp"
#include "barcode/complex/read_input.hpp"
#include "barcode/output/outputs.hpp"
#include "barcode/parts/part_files.hpp"
#include "common/arguments/numbers.hpp"
#include "common/files/batch_names.hpp"
#include "common/files/file_identity.hpp"
#include "common/system/process.hpp"
#include "common/terminal/exit_code.hpp"
#include "core/system/files.hpp"
#include "ph/parts/image_part.hpp"

namespace ph::barcode {
namespace {

/// "part 3 of 8", "parts 2 to 4 of 8"
std::string words_of(const ImagePart& part) {
  if (part.first() == part.last())
    return fmt::format("part {} of {}", part.first() + 1, part.parts());
  return fmt::format("parts {} to {} of {}", part.first() + 1, part.last() + 1, part.parts());
}

ImagePart of_file(const PartFile& file, const RunContext& context) {
  try {
    return ImagePart::of_bytes(file.bytes, context);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", file.path, error.what()));
  }
}

/// Whether the output is that part already. A file that is another is computed anew.
bool is_there(const std::string& path, const std::string& input, const Image& image,
              const ImagePartOptions& options, const Arguments& arguments, app::Session& session) {
  const auto bytes = kept_part_file(path, std::span(&input, 1), session);
  if (!bytes) return false;
  const auto [part, parts] = *arguments.part;
  std::string why = "is another part";
  try {
    if (ImagePart::of_bytes(*bytes, session.context()).is_of(image, part, parts, options))
      return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    why = error.what();
  }
  session.note(fmt::format("--resume: {}: {}: computed again", path, why));
  return false;
}

/// Joins, with the names of the files in what is said of parts that do not belong together.
void join(ImagePart& all, ImagePart next, const std::string& before, const std::string& path,
          const RunContext& context) {
  try {
    all.join(std::move(next), context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    throw Error(error.kind(), fmt::format("{}: {}; joined with {}", path, error.what(), before));
  }
}

/// Bars longer than what the user wants to see.
Barcode longer_than(double length, const Barcode& bars) {
  Barcode kept(bars.cell_kind());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    if (!bars[i].is_infinite() && !(bars[i].persistence() > length)) continue;
    const auto death = bars.death_cell(i);
    kept.add(bars[i], bars.birth_cell(i).numbers,
             death ? death->numbers : std::span<const Index>());
  }
  return kept;
}

BarcodeInfo info_of(const ImagePart& part, const Job& job, std::size_t files) {
  BarcodeInfo info;
  info.program = app::program_and_version("ph-barcode");
  info.input = job.input;
  info.input_description = fmt::format("image {}, {}", fmt::join(part.extents(), " x "),
                                       app::count_of(files, "part file"));
  info.complex = "cubical";
  info.max_dim =
      std::min(part.options().max_dim.value_or(0), static_cast<int>(part.extents().size()));
  info.threshold = part.options().cubical.threshold;
  info.superlevel = part.options().cubical.superlevel;
  info.engine = Engine(Engine::gradient).name();
  info.peak_memory = app::peak_memory();
  return info;
}

}  // namespace

Outcome run_image_part(const std::string& input, const Arguments& arguments,
                       app::Session& session) {
  const auto [part, parts] = *arguments.part;
  const std::string path =
      part_path(arguments.output, app::output_names({input}).front(), part, parts);
  app::require_in_scope(arguments.given, kImagePart, name_of(kImagePart));
  if (arguments.complex != ComplexKind::automatic && arguments.complex != ComplexKind::cubical)
    throw Error(ErrorKind::usage,
                "--complex: found another, expected cubical with --part of one "
                "input; of several inputs each may be of any kind");
  const Input opened =
      Input::open(files::path_of(input), &session.context(), Input::Excess::is_expected);
  if (arguments.format == Format::automatic && is_barcode(opened))
    throw Error(ErrorKind::usage,
                fmt::format("--part: {} is a barcode, expected an image", opened.name()));
  const NamedData data = read_input(opened, arguments, session.context());
  const std::string& description = data.read.description;
  const auto* const image = std::get_if<Image>(&data.read.data);
  if (image == nullptr)
    throw Error(ErrorKind::usage, fmt::format("--part: found {}, expected an image", description));
  session.explain(fmt::format("read {}: {}", data.name, description));
  if (arguments.read.allow_empty)
    session.explain("--allow-empty: not needed, the input is not empty");
  for (const std::string& note : data.read.notes)
    session.note(fmt::format("{}: {}", data.name, note));
  const ImagePartOptions options{.cubical = cubical_options(arguments, *image, data.read.periodic),
                                 .min_dim = arguments.options.min_dim,
                                 .max_dim = arguments.options.max_dim,
                                 .cells = arguments.keeps_cells};
  if (arguments.resumes && is_there(path, input, *image, options, arguments, session))
    return {app::kOk, fmt::format("{}: it is there already", path)};
  app::InputFiles inputs;
  inputs.add(input);
  app::require_separate(inputs, std::array{app::Written{"--output", path}}, arguments.common.force);
  if (const int layers = arguments.common.slab_layers; layers > 0)
    session.explain(
        fmt::format("slabs of {}", app::count_of(static_cast<std::size_t>(layers), "layer")));
  app::Output output(path);
  const ImagePart made = [&] {
    try {
      return ImagePart(*image, part, parts, options, session.context());
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::usage) throw;
      throw Error(error.kind(), fmt::format("--part: {}", error.what()));
    }
  }();
  const std::vector<std::byte> bytes = made.bytes();
  session.explain("memory " + app::format_size(static_cast<double>(session.memory_taken())));
  const app::BarHold results_are_written(session);
  output.file().write(bytes);
  output.commit();
  return {app::kOk, fmt::format("{}, {}: {}", description, words_of(made),
                                app::format_size(static_cast<double>(bytes.size())))};
}

Outcome join_image_parts(std::vector<PartFile> files, const Job& job, const Arguments& arguments,
                         app::Session& session) {
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
                  fmt::format("{}: {} is there twice, in {}, too", path, words_of(next), before));
    join(all, std::move(next), before, path, context);
  }
  if (is_part_path(job.output)) {
    app::Output output(job.output);
    const std::vector<std::byte> bytes = all.bytes();
    output.file().write(bytes);
    output.commit();
    return {app::kOk, fmt::format("{}: {}", words_of(all),
                                  app::format_size(static_cast<double>(bytes.size())))};
  }
  if (!all.is_whole())
    throw Error(
        ErrorKind::bad_data,
        fmt::format("--join: found {}, expected all; -o FILE.ph joins some", words_of(all)));
  if (job.format == BarcodeFormat::json && !all.options().cells)
    throw Error(ErrorKind::usage,
                "--output-format: found json, which shows the cells of bars; --part with "
                "--keep-cells stores them");
  const BarcodeInfo info = info_of(all, job, parts.size());
  Outputs outputs(job);
  Barcode bars = all.barcode(context);
  if (arguments.options.min_persistence > 0)
    bars = longer_than(arguments.options.min_persistence, bars);
  note_absent_dims(bars, arguments.look, session);
  const app::BarHold results_are_written(session);
  outputs.write(bars, info, look_of(arguments.look, info.superlevel), {}, context);
  return {app::kOk,
          fmt::format("{}: {}", info.input_description, app::count_of(bars.size(), "bar"))};
}

}  // namespace ph::barcode
