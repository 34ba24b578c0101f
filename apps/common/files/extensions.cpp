// SPDX-License-Identifier: MIT
#include "apps/common/files/extensions.hpp"

#include <fmt/format.h>

#include "ph/detail/io/reader.hpp"

namespace ph::app {

bool has_extension(std::string_view path) {
  const std::size_t name = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
  return path.find('.', name + 1) != path.npos && !path.ends_with("..");
}

std::string no_format_in(std::string_view path, std::string_view written) {
  return fmt::format("{}: the extension names no format, writing {}", printable(path), written);
}

}  // namespace ph::app
