// SPDX-License-Identifier: MIT
#include "barcode/parts/part_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "common/files/batch_names.hpp"
#include "core/system/files.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::barcode {

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
                                                     std::span<const std::string> inputs,
                                                     app::Session& session) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(files::path_of(path), error);
  if (error) {
    session.note(fmt::format("--resume: not needed, {} is not there", path));
    return std::nullopt;
  }
  for (const std::string& input : inputs) {
    const auto changed = std::filesystem::last_write_time(files::path_of(input), error);
    if (!error && changed <= written) continue;
    session.note(fmt::format("--resume: {} is older than {}: computed again", path, input));
    return std::nullopt;
  }
  return read_part_file(path, session);
}

}  // namespace ph::barcode
