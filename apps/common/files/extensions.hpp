// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

namespace ph::app {

/// Whether the name of a file has an extension. A leading dot hides a file; it starts none.
bool has_extension(std::string_view path);

/// "o.tsv: the extension names no format, writing csv"
std::string no_format_in(std::string_view path, std::string_view written);

/// @return the path. @throws Error (usage) if it promises a packed file (.gz and the like), which
/// nothing writes.
std::string require_unpacked(const std::string& path);

}  // namespace ph::app
