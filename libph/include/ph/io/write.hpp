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
  csv,     ///< header `dim,birth,death`, and `p` if there are p-values; one bar per line
  json,    ///< with the cells of each bar and the origin of the barcode
  ripser,  ///< the output of Ripser: intervals by dimension, 6 significant digits
  pers,    ///< GUDHI: one line `dim birth death` per bar
  dipha,   ///< DIPHA's binary persistence diagram
  npy,     ///< NumPy: float64 rows dim, birth, death
  none,    ///< nothing
};

// The next structs are not nested in BarcodeInfo, which has aliases for them: Clang does not let
// std::optional make an object whose members have initialisers while the enclosing class is
// incomplete.

/// A subsample: `points` points, chosen from `of` points.
struct BarcodeSubsample {
  Index points = 0, of = 0;
  double covering_radius = 0;
};

/// The grid of voxels into which points were converted.
struct BarcodeVoxelGrid {
  double voxel = 0;           ///< edge length
  std::vector<double> first;  ///< centre of the voxel at (0, ..., 0), in the points' coordinates
  std::string value;          ///< "distance", "occupancy" or "density"
};

/// Facts about an alpha complex: its values, its space and its hidden points.
struct BarcodeAlphaValues {
  bool squared = false;  ///< values are squares of radii
  /// Length of each axis, 0 if the axis does not close up; empty if no axis does.
  std::vector<double> period;
  std::vector<Index> hidden;  ///< points that are not part of the complex
};

/// The origin of a barcode: everything that the JSON format states in addition to the bars. Empty
/// members are left out; if `complex` is empty, the field of coefficients, the dimension and the
/// threshold are left out as well.
struct BarcodeInfo {
  std::string program;               ///< name and version
  std::string input;                 ///< path of the input
  std::string input_description;     ///< "1024 points in R^3, CSV"
  std::optional<Index> points;       ///< the number of points of the input
  std::optional<Index> coordinates;  ///< the number of coordinates of each point
  std::vector<Index> shape;          ///< extents of an image
  std::optional<Affine> affine;      ///< of an image, see ReadResult::affine
  bool nan_dropped = false;          ///< points or voxels with NaN were left out
  std::string complex;               ///< "rips", "cubical", "explicit", "lower-star", "alpha", …
  std::int64_t field = 2;
  int max_dim = 0;
  std::optional<double> threshold;
  std::optional<Index> vertices;     ///< of a Rips complex
  std::optional<std::size_t> edges;  ///< of a Rips complex, unless only points are held
  bool collapsed = false;            ///< edges were collapsed
  /// For a Rips complex, the kind of distance: "euclidean", "minkowski:3", see metric_name;
  /// "precomputed" (given by the user), "function" (a function of the user).
  std::string metric;
  /// For an image, the construction: "vertices" or "cells", see CubicalOptions::Construction.
  std::string construction;
  std::vector<int> periodic;  ///< axes of an image that close up
  /// If vertices have births, the source of the births and the weight exponent: "dtm 5, exponent
  /// 1".
  std::string vertex_weights;
  /// The subsample, if the points were chosen by a greedy permutation; see
  /// ph/greedy_permutation.hpp.
  using Subsample = BarcodeSubsample;
  std::optional<Subsample> subsample;
  /// The grid of voxels, if points were converted into an image; see ph/voxel_image.hpp.
  using VoxelGrid = BarcodeVoxelGrid;
  std::optional<VoxelGrid> voxels;
  /// Set for an alpha complex, or for another complex of the Delaunay triangulation.
  using AlphaValues = BarcodeAlphaValues;
  std::optional<AlphaValues> alpha;
  bool superlevel = false;              ///< values are the negated values of the image
  std::optional<double> approximation;  ///< epsilon of a sparse Rips filtration
  /// The loops of each bar, as ph::loops returns them, which are written next to the cycles. Empty
  /// if there are none.
  std::span<const BarLoops> loops;
  /// The p-value of each bar, written in CSV and JSON; NaN if a bar has none. Empty if no bar has
  /// one.
  std::span<const double> p_values;
  std::optional<double> min_persistence;  ///< bars of this length or less were left out
  int min_dim = 0;                        ///< bars of lower dimensions were left out
  std::vector<int> dims;  ///< if not empty, bars of all other dimensions were left out
  std::string engine;
  std::vector<std::pair<std::string, double>> timings;  ///< each stage with its seconds
  std::uint64_t peak_memory = 0;                        ///< bytes; 0 if unknown
};

/// One line of the table of barcode formats.
struct BarcodeFormatInfo {
  BarcodeFormat format;
  std::string_view name;         ///< "csv"
  std::string_view description;  ///< such as "a header, then one bar per line"
  std::string_view example;      ///< an example line; empty for binary formats
};

/// All formats, in the order of BarcodeFormat.
std::span<const BarcodeFormatInfo> barcode_formats();
/// The name of a format on the command line.
std::string_view barcode_format_name(BarcodeFormat format);
/// The format with this name; empty if there is none.
std::optional<BarcodeFormat> barcode_format_named(std::string_view name);
/// The format that a file name's extension stands for (.csv, .json, .ripser, .pers, .dipha or
/// .diagram, .npy), or nothing for an unknown one. Case does not matter.
std::optional<BarcodeFormat> barcode_format_of_path(std::string_view path);

/// Writes a barcode; the caller commits the file.
/// @throws Error (io) as OutputFile; Error (usage) on loops or p-values that do not belong to these
///         bars.
void write_barcode(OutputFile& file, const Barcode& barcode, BarcodeFormat format,
                   const BarcodeInfo& info = {});

/// Reads a barcode file of any format, which may be compressed with gzip. Cells and representatives
/// are read from JSON; the other formats store none. `pers` is accepted with and without GUDHI's
/// leading column of the characteristic; Ripser's text may have anything before its first heading.
/// @param format if empty, decided by content, then by extension. @param path "-" is standard
/// input.
/// @return the bars in the order of Barcode.
/// @throws Error (bad_data) "name:line:column (or byte): what, found X, expected Y" also on a bar
///         that dies before its birth; Error (no_input, io, resource) as the readers of read.hpp.
Barcode read_barcode(const std::filesystem::path& path,
                     std::optional<BarcodeFormat> format = std::nullopt,
                     const RunContext* context = nullptr);
Barcode read_barcode(const Input& input, std::optional<BarcodeFormat> format = std::nullopt);

/// For Input::open: refuses a stream that is no barcode of this format.
Input::StartCheck barcode_start_check(std::optional<BarcodeFormat> format = std::nullopt);

/// A barcode with everything that its file says about it.
struct StoredBarcode {
  Barcode bars;
  std::vector<BarLoops> loops = {};   ///< of each bar, as BarcodeInfo::loops; only JSON stores them
  std::vector<double> p_values = {};  ///< of each bar, as BarcodeInfo::p_values; from JSON and CSV
  /// Only JSON states facts. The loops and p-values are above.
  BarcodeInfo info = {};
  /// Data of the file that are not kept here: names of unknown JSON members, the name of a column
  /// ("persistence"), or "birth and death voxels" (NPY).
  std::vector<std::string> left_out = {};
};
StoredBarcode read_stored_barcode(const Input& input,
                                  std::optional<BarcodeFormat> format = std::nullopt);

/// True if a file is certainly a barcode: a header `dim,birth,death`, JSON, the output of Ripser,
/// DIPHA's diagram, or a file name that ends in .pers. Rows of numbers alone, in text or NPY, may
/// be anything.
bool is_barcode(const Input& input);

/// The file formats of a surface.
enum class SurfaceFormat {
  ply,  ///< binary; each vertex has the number of its point, each triangle has a flag `singular`
  off,  ///< text; the singular triangles come last
};
/// The format that a file name's extension stands for (.ply, .off), or nothing for an unknown one.
std::optional<SurfaceFormat> surface_format_of_path(std::string_view path);
/// Writes a surface with the points that it uses, in their order; the caller commits the file.
/// @param points the points of the mesh, in R³ or in R², where the third coordinate is written as
/// 0.
/// @param ids the numbers of the points in the input, one per point, below 2^32; if empty, their
/// positions.
/// @throws Error (usage) on points of a space other than R² and R³, on corners that are not points,
///         on more regular triangles than triangles, and on invalid `ids`; Error (io) as
///         OutputFile.
void write_surface(OutputFile& file, PointsView points, const SurfaceMesh& mesh,
                   SurfaceFormat format, std::span<const Index> ids = {});

/// The shortest text that reads back to the same double. Infinities and NaN become `inf`, `-inf`
/// and `nan`; -0 becomes 0.
std::string shortest(double value);

}  // namespace ph
