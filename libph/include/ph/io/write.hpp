// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/alpha.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/core/loop.hpp"
#include "ph/detail/io/output_file.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph {

/// The formats of a barcode file.
enum class BarcodeFormat {
  csv,     ///< header `dim,birth,death`, and `p` if there are p-values; a bar a line
  json,    ///< with the cells of each bar and where the barcode came from
  ripser,  ///< what Ripser prints: intervals by dimension, 6 significant digits
  pers,    ///< GUDHI: `dim birth death` a line
  dipha,   ///< DIPHA's binary persistence diagram
  npy,     ///< NumPy: float64 rows dim, birth, death
  none,    ///< nothing
};

// Outside of BarcodeInfo, where they are named: Clang does not let std::optional make an object
// whose members have initialisers while the class around it is not complete.

/// How points were chosen.
struct BarcodeSubsample {
  Index points = 0, of = 0;
  double covering_radius = 0;
};

/// The voxels that points became.
struct BarcodeVoxelGrid {
  double voxel = 0;           ///< edge
  std::vector<double> first;  ///< centre of the voxel at (0, ..., 0), in the points' coordinates
  std::string value;          ///< "distance", "occupancy" or "density"
};

/// What the values of an alpha complex are.
struct BarcodeAlphaValues {
  bool squared = false;        ///< values are squares of radii
  std::vector<double> period;  ///< of each axis, 0: it does not close up; empty: none does
  std::vector<Index> hidden;   ///< points that have no part in it
};

/// Where a barcode came from: what the JSON format says beside the bars. Empty fields are left out;
/// without a complex so are the field of coefficients, the dimension and the threshold.
struct BarcodeInfo {
  std::string program;            ///< name and version
  std::string input;              ///< path of the input
  std::string input_description;  ///< "1024 points in R^3, CSV"
  std::string complex;            ///< "rips", "cubical", "explicit", "lower-star", "alpha", …
  std::int64_t field = 2;
  int max_dim = 0;
  std::optional<double> threshold;
  /// Of a Rips complex, what distances are: "euclidean", "minkowski:3", see metric_name;
  /// "precomputed" (they were given), "function" (of the user's own).
  std::string metric;
  /// Of an image: "vertices" or "cells", as CubicalOptions::Construction.
  std::string construction;
  std::vector<int> periodic;  ///< axes of an image that close up
  /// Where vertices enter late: why and how, "dtm 5, exponent 1".
  std::string vertex_weights;
  /// Of a greedy permutation of the points; see ph/greedy_permutation.hpp.
  using Subsample = BarcodeSubsample;
  std::optional<Subsample> subsample;
  /// Where points were made an image of; see ph/voxel_image.hpp.
  using VoxelGrid = BarcodeVoxelGrid;
  std::optional<VoxelGrid> voxels;
  /// Of an alpha complex, or another of the Delaunay triangulation.
  using AlphaValues = BarcodeAlphaValues;
  std::optional<AlphaValues> alpha;
  bool superlevel = false;              ///< values are minus those of the image
  std::optional<double> approximation;  ///< epsilon of a sparse Rips filtration
  /// By bar of the barcode that is written, as ph::loops gives them: they stand beside the cycles.
  /// Empty: there are none.
  std::span<const BarLoops> loops;
  /// By bar, in CSV and JSON; NaN: it has none. Empty: there are none.
  std::span<const double> p_values;
  std::optional<double> min_persistence;  ///< bars of this length and less were left out
  int min_dim = 0;                        ///< bars of lower dimensions were left out
  std::string engine;
  std::vector<std::pair<std::string, double>> timings;  ///< stage, seconds
  std::uint64_t peak_memory = 0;                        ///< bytes; 0: unknown
};

/// One line of the table of barcode formats.
struct BarcodeFormatInfo {
  BarcodeFormat format;
  std::string_view name;         ///< "csv"
  std::string_view description;  ///< "a header, then a bar a line"
  std::string_view example;      ///< a line of it; empty for binary formats
};

/// All formats, in the order of BarcodeFormat.
std::span<const BarcodeFormatInfo> barcode_formats();
/// The name of a format on the command line, and back.
std::string_view barcode_format_name(BarcodeFormat format);
std::optional<BarcodeFormat> barcode_format_named(std::string_view name);
/// The format that a file name's extension stands for (.csv, .json, .ripser, .pers,
/// .dipha or .diagram, .npy); nothing for an unknown one. Case does not matter.
std::optional<BarcodeFormat> barcode_format_of_path(std::string_view path);

/// Writes a barcode; the caller commits the file.
/// @throws Error (io) as OutputFile; Error (usage) on loops or p-values that are not of these bars.
void write_barcode(OutputFile& file, const Barcode& barcode, BarcodeFormat format,
                   const BarcodeInfo& info = {});

/// Reads a barcode file of any format, also compressed with gzip; JSON brings its cells and
/// representatives back, the other formats have none. `pers` is taken with and without GUDHI's
/// leading column of the characteristic; text of Ripser may have anything before its first heading.
/// @param format empty: by content, then by extension. @param path "-" is standard input.
/// @return the bars in the order of Barcode.
/// @throws Error (bad_data) "name:line:column (or byte): what, found X, expected Y" also on a bar
///         that dies before its birth; Error (no_input, io, resource) as the readers of read.hpp.
Barcode read_barcode(const std::filesystem::path& path,
                     std::optional<BarcodeFormat> format = std::nullopt,
                     const RunContext* context = nullptr);
Barcode read_barcode(const Input& input, std::optional<BarcodeFormat> format = std::nullopt);

/// A barcode with what its file says about it.
struct StoredBarcode {
  Barcode bars;
  BarcodeInfo info;  ///< without loops and p-values; empty of all formats but JSON
  /// Members of the JSON that are not here, by name: "loops", "voxels", "p", others that nobody
  /// knows.
  std::vector<std::string> left_out;
};
StoredBarcode read_stored_barcode(const Input& input,
                                  std::optional<BarcodeFormat> format = std::nullopt);

/// Whether a file is a barcode for certain: a header `dim,birth,death`, JSON, text of Ripser,
/// DIPHA's diagram, or a name in .pers. Rows of numbers alone, in text or NPY, may be anything.
bool is_barcode(const Input& input);

/// The formats of a surface's file.
enum class SurfaceFormat {
  ply,  ///< binary; vertices with the number of their point, triangles with a mark `singular`
  off,  ///< text; the singular triangles come last
};
/// The format that a file name's extension stands for (.ply, .off); nothing for an unknown one.
std::optional<SurfaceFormat> surface_format_of_path(std::string_view path);
/// Writes a surface with the points that it has, in their order; the caller commits the file.
/// @param points of R², where the third coordinate is 0, or R³; the mesh is of them.
/// @param ids the numbers of the points in the input, one for each, below 2^32; empty: their own.
/// @throws Error (usage) on points of another space, corners that are none of the points, more
///         regular triangles than there are, and `ids` that are none; Error (io) as OutputFile.
void write_surface(OutputFile& file, PointsView points, const SurfaceMesh& mesh,
                   SurfaceFormat format, std::span<const Index> ids = {});

/// The shortest text that reads back to the same double; `inf`, `-inf`, `nan`; -0 as 0.
std::string shortest(double value);

}  // namespace ph
