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

/// What is known about each bar in addition to the barcode. It is written next to the bars.
struct BarData {
  /// The loops of each bar, as ph::loops returns them; only JSON stores them. Empty if there are
  /// none.
  std::span<const BarLoops> loops = {};
  /// The p-value of each bar, written in CSV and JSON; NaN if a bar has none. Empty if no bar has
  /// one.
  std::span<const double> p_values = {};
  /// The place of each bar, one row per bar, written in CSV; NaN if a bar has none. Empty if no bar
  /// has one.
  PointsView centroids = {};
  const BarcodeInfo* info = nullptr;  ///< an origin to state in place of Barcode::info; may be null
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

/// Writes a barcode; the caller commits the file. JSON states the origin, Barcode::info.
/// @throws Error (io) as OutputFile; Error (usage) on loops, p-values or centroids that do not
///         belong to these bars.
void write_barcode(OutputFile& file, const Barcode& barcode, BarcodeFormat format,
                   const BarData& data = {});

/// Reads a barcode file of any format, which may be compressed with gzip. Cells, representatives
/// and the origin, Barcode::info, are read from JSON; the other formats store none. `pers` is
/// accepted with and without GUDHI's leading column of the characteristic; Ripser's text may have
/// anything before its first heading.
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
  std::vector<BarLoops> loops = {};   ///< of each bar, as BarData::loops; only JSON stores them
  std::vector<double> p_values = {};  ///< of each bar, as BarData::p_values; from JSON and CSV
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
