// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

namespace ph::app {

/// True if the name of a file has an extension. A leading dot marks a hidden file instead of an
/// extension.
bool has_extension(std::string_view path);

/// Returns a message such as "o.tsv: the extension names no format, writing csv".
std::string no_format_in(std::string_view path, std::string_view written);

}  // namespace ph::app
