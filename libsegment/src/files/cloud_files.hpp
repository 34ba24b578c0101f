// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/detail/io/cloud_data.hpp"

namespace ph::segment {

/// The formats in which clouds are written.
enum class CloudFormat { pcd, ply };

/// By extension, in any case; "-" (standard output) is PCD.
/// @throws Error (usage) naming the path for another extension.
CloudFormat cloud_format_of(std::string_view path);

/// The file as bytes: binary_compressed PCD, little-endian PLY, with the names and types that other
/// programs read (see in_terms_of).
/// @throws Error (bad_data) if the format cannot hold a field.
std::string cloud_bytes(Cloud cloud, CloudFormat format);

}  // namespace ph::segment
