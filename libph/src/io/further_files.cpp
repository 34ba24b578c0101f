// SPDX-License-Identifier: MIT
#include "ph/detail/io/further_files.hpp"

#include <fstream>
#include <optional>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/bytes/unpack.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

namespace fs = std::filesystem;

// The first bytes of the content of a file, which may be compressed. There are fewer than `most`
// only if the content has no more.
std::string start_of(const fs::path& path, std::size_t most) {
  std::ifstream file(path, std::ios::binary);
  // Deflate never makes data twice as large.
  std::string start(2 * most + 1024, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return is_gzip(start) ? unpacked_start(start, most) : start.substr(0, most);
}

// The format that automatic detection finds. The first bytes decide on the formats of headers.
std::optional<Format> format_of(const fs::path& path) {
  constexpr std::size_t enough = 4096;
  const bool is_packed = ends_in(path.string(), ".gz");
  return format_by_content(
      Input::view(start_of(path, enough), (is_packed ? path.stem() : path).string()));
}

// The name of the file that a header names. Only as much is read as the header may take, because
// the data may follow it. Nobody writes a header of a mebibyte, and damaged files are not to take
// much memory.
std::optional<std::string> data_file_of(const fs::path& path, Format format) {
  constexpr std::size_t first = std::size_t{1} << 16, last = std::size_t{1} << 20;
  for (std::size_t most = first; most <= last; most *= 4) {
    const std::string start = start_of(path, most);
    const bool is_whole = start.size() < most;
    const Input header = Input::view(start, path.string());
    try {
      auto name = format == Format::nrrd ? nrrd_data_file(header) : meta_image_data_file(header);
      // The name may be cut as well.
      if (is_whole || !name) return name;
    } catch (const Error&) {
      if (is_whole) throw;
    }
  }
  return std::nullopt;
}

std::vector<fs::path> slices_of(const fs::path& path, Format format) {
  std::vector<fs::path> slices;
  for (const std::string& name : slices_in(Input::of_folder(path), format))
    slices.push_back(path / files::path_of(name));
  return slices;
}

}  // namespace

std::vector<fs::path> further_files(const fs::path& path, Format format) {
  if (path == "-") return {};  // standard input
  try {
    const auto status = files::status_of(path);
    if (status && status->kind == files::Kind::folder) return slices_of(path, format);
    if (!status || status->kind != files::Kind::regular) return {};
    const std::optional<Format> known = format == Format::automatic ? format_of(path) : format;
    if (known != Format::nrrd && known != Format::metaimage) return {};
    const std::optional<std::string> name = data_file_of(path, *known);
    if (!name) return {};
    return {path.parent_path() / files::path_of(*name)};
  } catch (const Error&) {
    return {};
  }
}

}  // namespace ph::detail
