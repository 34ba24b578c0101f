// SPDX-License-Identifier: MIT
#pragma once
#include "files/cloud_files.hpp"

namespace ph::segment {

/// The same points with the fields that other programs look for in files of a format.
///
/// * Normals are `normal_x normal_y normal_z` in PCD, and `nx ny nz` in PLY.
/// * Colours are one number `rgba` in PCD. Those of one byte each become that; others stay beside
///   it. (`write_ply` takes it apart again.)
/// * Padding (`_`) is left out: PCL does not count it in compressed files.
/// * Coordinates and normals of PCD are in single precision, which alone PCL and Open3D read as
///   such. Doubles are rounded if all coordinates are within kSinglePrecisionReach.
Cloud in_terms_of(CloudFormat format, Cloud cloud);

/// Metres, within which single precision moves a coordinate by 0.03 mm at most.
inline constexpr double kSinglePrecisionReach = 1024;

}  // namespace ph::segment
