// SPDX-License-Identifier: MIT
#include "common/files/extensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "ph/detail/io/reader.hpp"
#include "ph/error.hpp"

namespace ph::app {

bool has_extension(std::string_view path) {
  const std::size_t name = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
  return path.find('.', name + 1) != path.npos && !path.ends_with("..");
}

std::string no_format_in(std::string_view path, std::string_view written) {
  return fmt::format("{}: the extension names no format, writing {}", printable(path), written);
}

std::string require_unpacked(const std::string& path) {
  constexpr std::array<std::string_view, 6> kPacked{".gz", ".bz2", ".xz", ".zst", ".zip", ".7z"};
  std::string lower(path);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (const std::string_view packed : kPacked)
    if (lower.ends_with(packed))
      throw Error(ErrorKind::usage,
                  fmt::format("{}: found {}, expected a name without it: outputs are not packed",
                              printable(path), packed));
  return path;
}

}  // namespace ph::app
