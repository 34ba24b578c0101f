// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ph/detail/io/reader.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/explicit.hpp"
#include "ph/image.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// What stands on the diagonal of a square matrix of distances.
enum class Diagonal {
  zero,    ///< 0, but for rounding: else an error
  any,     ///< anything, taken for 0
  births,  ///< when each point enters
};

/// How an asymmetric square matrix becomes a distance matrix.
enum class Symmetrise {
  none,   ///< it is an error, if they differ by more than 1e-6 of the largest entry
  max,    ///< d(i,j) = max of both entries
  min,    ///< d(i,j) = min of both entries
  lower,  ///< the entry below the diagonal
};

/// What a NaN in the input means.
enum class NanPolicy {
  error,  ///< bad data; only a hole of a point cloud is accepted
  drop,   ///< points: the row is left out; distances: the pair is never joined (+infinity);
          ///< images: the voxel is absent, see Image::masked
};

/// What a two-dimensional array (NPY), or a text of numbers, holds.
enum class ArrayMeaning {
  automatic,  ///< what its shape, its type and its diagonal say, with a note; else an image (NPY)
              ///< or points (text)
  rips,       ///< points or distances, as its diagonal says
  image,      ///< values of pixels
  points,     ///< a point a row
  distances,  ///< a square distance matrix
};

/// Which number of a pixel is its value.
enum class Channel {
  automatic,  ///< the only one there is, or the one that all are equal to
  grey,       ///< of colours: their luma by ITU-R BT.601, 0.299 R + 0.587 G + 0.114 B, to the
              ///< nearest integer
  red,
  green,
  blue,
  alpha,  ///< opacity
};

/// How an image lies in a file that does not say so itself.
struct RawLayout {
  std::vector<Index> extents = {};  ///< sizes of the axes, the last one fastest
  std::string type = "u1";          ///< as in NumPy: u1 u2 u4 u8 i1 i2 i4 i8 f2 f4 f8
  bool big_endian = false;          ///< the high byte comes first
  std::size_t skip = 0;             ///< bytes before the first voxel
};

/// How input is taken. The defaults refuse whatever is doubtful, with an error that names the
/// setting.
struct ReadOptions {
  bool allow_empty = false;                      ///< an input without data is an empty result
  Symmetrise symmetrise = Symmetrise::none;      ///< of square matrices
  bool from_correlation = false;                 ///< d = 1 - r; the diagonal must be 1
  Diagonal diagonal = Diagonal::zero;            ///< of square matrices
  NanPolicy nan = NanPolicy::error;              ///< see NanPolicy
  ArrayMeaning array = ArrayMeaning::automatic;  ///< used by read_any
  std::vector<std::string> columns = {};         ///< of tables: names, "3", "2-5"; empty: all
  Channel channel = Channel::automatic;          ///< of pictures
  std::optional<RawLayout> raw = {};             ///< used by read_any for Format::raw
  /// Budget and stop token of what is opened by its path; null: none. An open Input has its own.
  const RunContext* context = nullptr;
  std::function<void(Message)> note = {};  ///< told what was assumed, one line each
  std::vector<Index>* dropped = nullptr;   ///< receives the rows left out, ascending
};

// Every reader takes a path ("-" is standard input) or an open Input. All throw
//   Error (bad_data)   "name:line:column (or byte): what, found X, expected Y; hint"
//   Error (no_input)   the file is missing, unreadable or a directory
//   Error (io)         reading broke off, or there is no room for a temporary file
//   Error (resource)   the budget of the context would be exceeded
//   Error (cancelled)  a stop was requested
//   Error (usage)      options.columns name one that is not there, or an option does not fit
// They need linear time, and never allocate more than in proportion to the bytes that are there.

/// Points, one a line: numbers separated by blanks, commas or semicolons. A first row without any
/// number is skipped with a note. Also takes NPY (2-D), NPZ, PCD and PLY, by content.
/// @return one point a row. No points are an error unless options.allow_empty.
Points read_points(const std::filesystem::path& path, const ReadOptions& options = {});
Points read_points(const Input& input, const ReadOptions& options = {});

/// A full square matrix: as many columns as rows, zero diagonal, symmetric (see Symmetrise);
/// +infinity: never joined. With options.from_correlation a correlation matrix, with
/// Diagonal::births one that has the births of its points there. Also takes NPY, NPZ and
/// DIPHA's distance matrices.
DistanceMatrix read_distances(const std::filesystem::path& path, const ReadOptions& options = {});
DistanceMatrix read_distances(const Input& input, const ReadOptions& options = {});

/// The strict lower triangle, row i with i numbers (the empty row 0 may be left out), or all of it
/// on one line.
DistanceMatrix read_lower_distances(const std::filesystem::path& path,
                                    const ReadOptions& options = {});
DistanceMatrix read_lower_distances(const Input& input, const ReadOptions& options = {});

/// The strict upper triangle, row i with n-1-i numbers, or all of it on one line (the condensed
/// form of SciPy).
DistanceMatrix read_upper_distances(const std::filesystem::path& path,
                                    const ReadOptions& options = {});
DistanceMatrix read_upper_distances(const Input& input, const ReadOptions& options = {});

/// The strict lower triangle as float32, little endian, without a header.
DistanceMatrix read_binary_distances(const std::filesystem::path& path,
                                     const ReadOptions& options = {});
DistanceMatrix read_binary_distances(const Input& input, const ReadOptions& options = {});

/// Pairs of points, one a line: `i j d`, ids from 0; the number of points is the largest id + 1.
/// A pair may be listed twice if its distance is the same. Also takes DIPHA's sparse distance
/// matrices, which say the number of points.
SparseDistances read_sparse(const std::filesystem::path& path, const ReadOptions& options = {});
SparseDistances read_sparse(const Input& input, const ReadOptions& options = {});

/// An array of any dimension from NPY, NPZ, PNG, PGM, DIPHA or NIfTI, by content. The axes
/// are those of the file, in C order: a picture has (y, x), DIPHA and NIfTI have (x, y, z).
/// +-infinity is legal; NaN is an error or, with NanPolicy::drop, an absent voxel. An array (but
/// one of an archive) that would take more than a third of the memory left in the budget stays in
/// its file, or in a temporary one where it is stored in another way than in memory; the file must
/// not change meanwhile.
Image read_image(const std::filesystem::path& path, const ReadOptions& options = {});
Image read_image(const Input& input, const ReadOptions& options = {});
/// NumPy's .npy: booleans, integers, floats (16, 32, 64 bits), both byte orders and both storage
/// orders; the result is in C order. Also an .npz that holds one array, or the array that
/// Input::member names ("scans.npz:brain").
Image read_npy_image(const Input& input, const ReadOptions& options = {});

/// NIfTI-1 in one file (.nii): integers and floats of up to 8 bytes, both byte orders, 1 to 7 axes
/// without the trailing ones of size 1; values are scaled by scl_slope and scl_inter.
Image read_nifti(const std::filesystem::path& path, const ReadOptions& options = {});
Image read_nifti(const Input& input, const ReadOptions& options = {});

/// The numbers of an image and nothing else but what is skipped: exactly as many as there are
/// voxels. @throws also Error (usage) on a layout without axes or of another type.
Image read_raw(const Input& input, const RawLayout& layout, const ReadOptions& options = {});

/// An image with the axes that close up on themselves.
struct PerseusImage {
  Image image;
  std::vector<bool> periodic;  ///< one an axis
};

/// Perseus' cubical text. A grid: dimension, a size for each axis (negative: periodic, as in
/// GUDHI), the values with the first axis fastest. Or a list of cubes: dimension, then coordinates
/// from 0 and the value of a cube a line; others never enter. A value of -1 never enters if all
/// others are positive integers, as Perseus has it; else it is a value, as in GUDHI. A note says
/// which.
PerseusImage read_perseus(const std::filesystem::path& path, const ReadOptions& options = {});
PerseusImage read_perseus(const Input& input, const ReadOptions& options = {});

/// Filtered simplices with the lines they come from.
struct SimplicesInput {
  SimplexList simplices;
  std::vector<std::size_t> lines;  ///< simplex i is on lines[i], from 1
  std::string name;                ///< of the file, printable
  /// Values on the vertices 0, 1, …, from a file of their own (read_any); else empty.
  std::vector<double> vertex_values;

  /// "name:line" for messages about a simplex; a copy that may outlive this object.
  CellNamer namer() const;
};

/// Simplices `v0 v1 … : value`, one a line in any order; a value may be infinite but not NaN.
SimplicesInput read_simplices(const std::filesystem::path& path, const ReadOptions& options = {});
SimplicesInput read_simplices(const Input& input, const ReadOptions& options = {});

/// A boundary matrix with the places its columns come from.
struct BoundaryInput {
  BoundaryMatrix matrix;
  std::vector<std::size_t> places;  ///< of column i: line (text, from 1) or byte offset (binary)
  bool binary = false;
  std::string name;  ///< of the file, printable

  CellNamer namer() const;
};

/// PHAT's boundary matrices over Z/2. Text: a cell a line, its dimension, then the indices of its
/// facets. Binary: int64 little endian: number of cells, then for each cell dimension, number of
/// facets, facets. Indices count from 0 and name earlier columns, ascending. Also takes DIPHA's
/// weighted boundary matrices, in which they may come in any order.
/// @param values_path one value a cell: text, or float64 little endian; empty: positions are
/// values.
BoundaryInput read_phat(const std::filesystem::path& path,
                        const std::filesystem::path& values_path = {},
                        const ReadOptions& options = {});
BoundaryInput read_phat(const Input& input, const ReadOptions& options = {});

/// `count` numbers, as text or as raw float64 little endian. @param owner what has one each, for
/// messages. @throws Error (bad_data) on another count or a NaN.
std::vector<double> read_values(const Input& input, std::size_t count,
                                const ReadOptions& options = {}, std::string_view owner = "cell");

/// A polygon mesh: face f has the vertices corners[offsets[f] … offsets[f+1]).
struct Mesh {
  Points vertices;  ///< one a row, three columns
  std::vector<Index> corners;
  std::vector<std::size_t> offsets{0};
  std::vector<double> values;  ///< one a vertex, or empty

  std::size_t faces() const { return offsets.empty() ? 0 : offsets.size() - 1; }
};

/// OFF (Geomview), text. @throws Error (bad_data) also on a face that names a missing vertex.
Mesh read_off(const std::filesystem::path& path, const ReadOptions& options = {});
Mesh read_off(const Input& input, const ReadOptions& options = {});
/// The vertices and faces of a PLY file; reading clouds with all their fields: cloud.hpp.
Mesh read_ply_mesh(const std::filesystem::path& path, const ReadOptions& options = {});
Mesh read_ply_mesh(const Input& input, const ReadOptions& options = {});

/// The input formats, in the order of the programs' `--format` option.
enum class Format {
  automatic,  ///< by content and extension
  points,
  distance,
  lower_distance,
  upper_distance,
  sparse,
  binary,
  dipha,
  npy,
  pgm,
  png,
  perseus,
  nifti,
  phat,
  simplices,
  off,
  ply,
  pcd,
  npz,
  xyz,
  pts,
  raw,
  grid,
};

/// What was read, whatever the format.
struct ReadResult {
  std::variant<Points, DistanceMatrix, SparseDistances, Image, SimplicesInput, BoundaryInput, Mesh>
      data;
  Format format = Format::automatic;  ///< never automatic in a result
  std::string description;            ///< "1024 points in R^3, CSV"
  std::vector<Message> notes;         ///< what was assumed: "line 1 is a header: skipped"
  /// For Points: row i is point point_ids[i] of the input. Empty: row i is point i, none was left
  /// out.
  std::vector<Index> point_ids;
  /// For an Image: the axes that the file says close up on themselves. Empty: none.
  std::vector<bool> periodic;
};

/// One line of the table of formats: its name, what it is, and a line of it.
struct FormatInfo {
  Format format;
  std::string_view name;     ///< "points"
  std::string_view marked;   ///< the description with its marks
  std::string_view example;  ///< "0.5 1.25 -3e-2"
  /// Null if the format is not built in.
  ReadResult (*read)(const Input&, const ReadOptions&);

  /// "one point a line: numbers separated by blanks or commas"
  Message description() const { return marked; }
};

/// All formats. Adding one is a function and a line of this table.
std::span<const FormatInfo> formats();
const FormatInfo& format_info(Format format);
/// The format of a name of `--format` ("lower-distance").
std::optional<Format> format_from_name(std::string_view name);

/// Decides by magic numbers, then by extension, then by the shape of the first lines. Never
/// returns Format::automatic; text of numbers without more evidence is `points`. Reads no options:
/// see read_any for text that they tell more about.
Format detect_format(const Input& input);

/// Reads any format.
/// @param path "-" is standard input. @param format Format::automatic: see detect_format.
/// @param values_path values of the cells of a boundary matrix or of the vertices of a mesh; empty:
///        none. @throws Error as the readers do; Error (not_built_in) if the format is not there;
///        Error (usage) if values are given for a format that takes none.
ReadResult read_any(const std::filesystem::path& path, Format format = Format::automatic,
                    const ReadOptions& options = {}, const std::filesystem::path& values_path = {});
ReadResult read_any(const Input& input, Format format = Format::automatic,
                    const ReadOptions& options = {}, const std::filesystem::path& values_path = {});

}  // namespace ph
