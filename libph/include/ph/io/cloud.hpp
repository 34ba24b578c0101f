// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/io/camera.hpp"
#include "ph/detail/io/cloud_data.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/image.hpp"
#include "ph/io/read.hpp"

namespace ph {

// The readers throw the same errors as the readers of read.hpp. A cloud without points is an error
// unless options.allow_empty; a NaN coordinate is a hole, not an error.

/// Recognises PCD and PLY by content or extension, and NPY by content. Anything else is text: PTS
/// if the extension is .pts and the first line is a number, otherwise as read_xyz reads it. A cloud
/// without the fields x, y and z is an error.
Cloud read_cloud(const std::filesystem::path& path, const ReadOptions& options = {});
Cloud read_cloud(const Input& input, const ReadOptions& options = {});

/// For Input::open: refuses a stream that read_cloud cannot read.
Input::StartCheck cloud_start_check();

/// PCD 0.7 (and 0.5, 0.6): ascii, binary, binary_compressed; organised or not; all fields.
Cloud read_pcd(const Input& input, const ReadOptions& options = {});

/// PLY 1.0: ascii, both byte orders. Reads the vertices with all their scalar properties; list
/// properties of vertices and all other elements are checked and skipped.
Cloud read_ply(const Input& input, const ReadOptions& options = {});

/// Text, one point per line: x y z, then more columns. A header line, if there is one, names the
/// columns; without it columns 4 to 6 are red green blue if all are integers in 0…255, otherwise
/// field_3, …. Coordinates are kept as float64. "nan" is a hole. Of a molecule (the number of
/// atoms, a line of text, then lines "C x y z"), the coordinates alone are read.
Cloud read_xyz(const Input& input, const ReadOptions& options = {});

/// PTS: the number of points on the first line, then lines of x y z, followed by an intensity (4
/// columns), red green blue (6) or both (7).
Cloud read_pts(const Input& input, const ReadOptions& options = {});

/// The coordinates of all points, including holes (NaN), in double precision.
/// @throws Error (bad_data) if x, y or z is missing.
Points points_of(const Cloud& cloud);

/// NumPy array (.npy) of floats: shape (n, 3), or (rows, columns, 3) for an organised cloud; the
/// last axis may be longer. The columns mean the same as in read_xyz without a header; red green
/// blue may also be numbers in 0…1. NaN is a hole.
Cloud read_npy_cloud(const Input& input, const ReadOptions& options = {});

/// A depth image as its file stores it.
struct DepthImage {
  Image depth;          ///< two axes: rows, columns
  double scale = 1000;  ///< default number of depth units per metre: 1 for floats in NPY (metres),
                        ///< 1000 for whole numbers (millimetres)
};
/// A PNG of one channel, PGM, or a NumPy array (.npy) with two axes. NaN is an absent pixel: a hole
/// for cloud_from_depth. @throws Error (bad_data) also on more channels or other axes.
DepthImage read_depth(const Input& input, const ReadOptions& options = {});
/// For Input::open: refuses a stream that read_depth cannot read.
Input::StartCheck depth_start_check();

/// The numbers of pixels of a depth image that have a depth but become holes, by reason.
struct DepthCounts {
  Index negative = 0;  ///< pixels with a depth below 0
  Index unseen = 0;    ///< pixels that no ray through the lens reaches
};

/// The organised cloud of a depth image: x right, y down, z forward, metres; fields x y z (float32)
/// and, with a colour image, rgba (uint32). Depth is along z. A pixel whose depth is infinite, NaN,
/// or not above 0 becomes a hole.
/// @param depth an image with two axes. @param colour grey or RGB(A), of the same size.
/// @param camera its size must be the size of the image, or 0.
/// @param depth_scale depth units per metre: 1000 for millimetres.
/// @param counts receives the counts; may be null.
/// @throws Error (bad_data) if the colours have another size; Error (usage) if the camera has
///         another size, on focal lengths or a scale that are not positive, or on another number of
///         axes.
Cloud cloud_from_depth(const Image& depth, const std::optional<Raster>& colour,
                       const Camera& camera, double depth_scale = 1000,
                       DepthCounts* counts = nullptr);

enum class PcdData { ascii, binary, binary_compressed };
enum class PlyData { ascii, little_endian };

/// Writes all fields with their bytes unchanged; ascii numbers are the shortest text that reads
/// back the same.
/// @throws Error (io) if the stream fails.
void write_pcd(std::ostream& out, const Cloud& cloud, PcdData data = PcdData::binary_compressed);

/// Writes all fields as vertex properties. PLY has neither packed colours nor 64-bit integers: a
/// field rgb or rgba becomes red green blue (alpha); fields with a count become name_0, name_1, ….
/// @throws Error (bad_data) on a 64-bit integer field; Error (io) if the stream fails.
void write_ply(std::ostream& out, const Cloud& cloud, PlyData data = PlyData::little_endian);

/// Writes one label per point as NPY, uint32 little endian: shape (height, width) if height > 1,
/// otherwise (width). @throws Error (bad_data) if the number of labels differs from the number of
/// points; Error (io) if the stream fails.
void write_npy(std::ostream& out, std::span<const std::uint32_t> labels, Index width,
               Index height = 1);

}  // namespace ph
