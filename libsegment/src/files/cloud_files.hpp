// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/detail/io/cloud_data.hpp"

namespace ph::segment {

/// The formats in which clouds can be written.
enum class CloudFormat { pcd, ply };

/// The format by extension, in any case; "-" (standard output) is PCD.
/// @throws Error (usage) naming the path on another extension.
CloudFormat cloud_format_of(std::string_view path);

/// The bytes of the file: binary_compressed PCD or little-endian PLY, with the names and types that
/// other programs read (see in_terms_of).
/// @throws Error (bad_data) if the format cannot hold a field.
std::string cloud_bytes(Cloud cloud, CloudFormat format);

}  // namespace ph::segment
