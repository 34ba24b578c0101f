// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/detail/io/cloud_data.hpp"

namespace ph::segment {

/// The formats in which clouds can be written.
enum class CloudFormat { pcd, ply };

/// The format that the extension names, in upper or lower case; "-" (standard output) is PCD.
/// @throws Error (usage) naming the path on another extension.
CloudFormat cloud_format_of(std::string_view path);

/// The bytes of the file: binary_compressed PCD or little-endian PLY, with the names and types that
/// other programs read (see in_terms_of).
/// @throws Error (bad_data) if the format cannot hold a field.
std::string cloud_bytes(Cloud cloud, CloudFormat format);

/// The same points with the fields that other programs look for in a format's files.
///
/// * Normals are `normal_x normal_y normal_z` in PCD, and `nx ny nz` in PLY.
/// * Colours are one number `rgba` in PCD. Colours of one byte per channel become that number;
///   colours of other types keep their own fields. (`write_ply` splits the number into channels
///   again.)
/// * Padding (`_`) is left out, because PCL does not count it in compressed files.
/// * Coordinates and normals of PCD are in single precision, the only precision in which PCL and
///   Open3D recognise them. Doubles are rounded if all coordinates are within
///   kSinglePrecisionReach.
Cloud in_terms_of(CloudFormat format, Cloud cloud);

/// The distance in metres up to which single precision moves a coordinate by at most 0.03 mm.
inline constexpr double kSinglePrecisionReach = 1024;

}  // namespace ph::segment
