// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include "ph/io/cloud.hpp"
#include "ph/io/png.hpp"
#include "ph/io/read.hpp"

namespace ph {

// The readers throw as those of read.hpp do. A cloud without points is an error unless
// options.allow_empty; a NaN coordinate is a hole and no error.

/// By content (PCD, PLY), else text: see read_xyz and read_pts. A cloud without the fields x, y and
/// z is an error.
Cloud read_cloud(const std::filesystem::path& path, const ReadOptions& options = {});
Cloud read_cloud(const Input& input, const ReadOptions& options = {});

/// PCD 0.7 (and 0.5, 0.6): ascii, binary, binary_compressed; organised or not; all fields.
Cloud read_pcd(const Input& input, const ReadOptions& options = {});

/// PLY 1.0: ascii, both byte orders. The vertices with all their scalar properties; lists of a
/// vertex and all other elements are checked and skipped.
Cloud read_ply(const Input& input, const ReadOptions& options = {});

/// Text, one point a line: x y z, then more columns. Columns are named by a header line if there is
/// one; without it columns 4 to 6 are red green blue if all are integers of 0…255, else field_3, ….
/// Coordinates are kept as float64. "nan" is a hole.
Cloud read_xyz(const Input& input, const ReadOptions& options = {});

/// PTS: the number of points on the first line, then x y z, with an intensity (4 columns), red
/// green blue (6) or both (7) behind them.
Cloud read_pts(const Input& input, const ReadOptions& options = {});

/// The coordinates of all points, holes (NaN) included, in double precision.
/// @throws Error (bad_data) if x, y or z is missing.
Points points_of(const Cloud& cloud);

/// A pinhole camera, in pixels.
struct Intrinsics {
  double fx = 0, fy = 0;  ///< focal lengths
  double cx = 0, cy = 0;  ///< principal point; the centre of pixel (0, 0) is (0, 0)
};

/// The organised cloud of a depth image: x right, y down, z forward, metres; fields x y z (float32)
/// and, with a colour image, rgba (uint32). A depth of 0 is a hole.
/// @param depth grey, 8 or 16 bits. @param colour grey or RGB(A), of the same size.
/// @param depth_scale depth units a metre: 1000 for millimetres.
/// @throws Error (bad_data) if the sizes differ or depth is not grey; Error (usage) on focal
/// lengths
///         or a scale that are not positive.
Cloud cloud_from_depth(const Raster& depth, const std::optional<Raster>& colour,
                       const Intrinsics& intrinsics, double depth_scale = 1000);

enum class PcdData { ascii, binary, binary_compressed };
enum class PlyData { ascii, little_endian };

/// All fields, bytes unchanged; ascii numbers are the shortest text that reads back the same.
/// @throws Error (io) if the stream fails.
void write_pcd(std::ostream& out, const Cloud& cloud, PcdData data = PcdData::binary_compressed);

/// All fields as vertex properties. PLY knows no rgb packed in a float and no 64-bit integers: a
/// field rgb or rgba becomes red green blue (alpha); fields with a count become name_0, name_1, ….
/// @throws Error (bad_data) on a 64-bit integer field; Error (io) if the stream fails.
void write_ply(std::ostream& out, const Cloud& cloud, PlyData data = PlyData::little_endian);

/// One label a point as NPY, uint32 little endian: shape (height, width) if height > 1, else
/// (width). @throws Error (io) if the stream fails.
void write_npy(std::ostream& out, std::span<const std::uint32_t> labels, Index width,
               Index height = 1);

}  // namespace ph
