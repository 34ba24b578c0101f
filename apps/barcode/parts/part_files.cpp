// SPDX-License-Identifier: MIT
#include "apps/barcode/parts/part_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "apps/common/files/batch_names.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::barcode {
namespace {

/// Keeps only infinite bars and bars longer than the user's limit.
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

}  // namespace

bool is_part_path(const std::string& path) { return path.ends_with(".ph"); }

std::string part_path(const std::string& output, const std::string& name, int part, int parts) {
  if (!output.ends_with('/') && !app::is_folder(output)) return output;
  app::prepare_outputs("--output", output);
  return app::filled(output, name, fmt::format(".{}of{}.ph", part + 1, parts));
}

std::vector<std::byte> read_part_file(const std::string& path, app::Session& session) {
  const Input input = Input::open(files::path_of(path), &session.context());
  const auto bytes = input.bytes();
  return {bytes.begin(), bytes.end()};
}

std::optional<std::vector<std::byte>> kept_part_file(const std::string& path,
                                                     app::Session& session) {
  std::error_code error;
  if (!std::filesystem::exists(files::path_of(path), error)) {
    session.note(fmt::format("--resume: not needed, because {} does not exist", path));
    return std::nullopt;
  }
  return read_part_file(path, session);
}

std::string write_part_file(app::Output& output, std::span<const std::byte> bytes) {
  output.file().write(bytes);
  output.commit();
  return format_size(static_cast<double>(bytes.size()));
}

BarcodeInfo named(BarcodeInfo info, const std::string& description, const Job& job) {
  info.program = app::program_and_version("ph-barcode");
  info.input = job.places.input;
  info.input_description = description;
  info.peak_memory = app::peak_memory();
  return info;
}

Outcome write_bars(Barcode bars, BarcodeInfo info, Outputs& outputs, const Job& job,
                   app::Session& session) {
  info.min_persistence = job.question.options.min_persistence;  // mutant: json-min-persistence
  if (job.question.options.min_persistence > 0)
    bars = longer_than(job.question.options.min_persistence, bars);
  note_absent_dims(bars, job.results.look, session);
  const app::BarHold results_are_written(session);
  bars.set_info(info);
  outputs.write(bars, {}, look_of(job.results.look, info.superlevel), {}, session.context());
  return {app::kOk,
          fmt::format("{}: {}", info.input_description, app::count_of(bars.size(), "bar"))};
}

}  // namespace ph::barcode
