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

#include "ph/detail/core/barcode_info.hpp"
#include "ph/detail/core/names.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/explicit.hpp"
#include "ph/image.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// The meaning of the diagonal of a square matrix of distances.
enum class Diagonal {
  zero,    ///< 0 up to rounding; anything else is an error
  any,     ///< ignored, and taken as 0
  births,  ///< the value at which each point enters
};

template <>
inline constexpr std::array names_of<Diagonal>{
    Named{Diagonal::zero, "zero"},
    Named{Diagonal::any, "any"},
    Named{Diagonal::births, "births"},
};

/// The way to turn an asymmetric square matrix into a distance matrix.
enum class Symmetrise {
  none,   ///< an error if entries differ by more than 1e-6 of the largest one
  max,    ///< d(i,j) = max of both entries
  min,    ///< d(i,j) = min of both entries
  lower,  ///< the entry below the diagonal
};

template <>
inline constexpr std::array names_of<Symmetrise>{
    Named{Symmetrise::none, "none"},
    Named{Symmetrise::max, "max"},
    Named{Symmetrise::min, "min"},
    Named{Symmetrise::lower, "lower"},
};

/// The meaning of a NaN in the input.
enum class NanPolicy {
  error,  ///< bad data; only a hole of a point cloud is accepted
  drop,   ///< points: the row is left out; distances: the pair is never joined (+infinity); images:
          ///< the voxel is absent, see Image::masked
};

template <>
inline constexpr std::array names_of<NanPolicy>{
    Named{NanPolicy::error, "error"},
    Named{NanPolicy::drop, "drop"},
};

/// The content of a two-dimensional array (NPY), or of a text file of numbers.
enum class ArrayMeaning {
  automatic,  ///< decided by shape, type and diagonal, with a note; by default an image (NPY) or
              ///< points (text)
  rips,       ///< points or distances, decided by the diagonal
  image,      ///< values of pixels
  points,     ///< one point per row
  distances,  ///< a square distance matrix
};

template <>
inline constexpr std::array names_of<ArrayMeaning>{
    Named{ArrayMeaning::automatic, "auto"},      Named{ArrayMeaning::rips, "rips"},
    Named{ArrayMeaning::image, "image"},         Named{ArrayMeaning::points, "points"},
    Named{ArrayMeaning::distances, "distances"},
};

/// The channel of a picture that gives each pixel its value.
enum class Channel {
  automatic,  ///< the only channel, or the value that all channels share
  grey,       ///< for colours: their luma by ITU-R BT.601, 0.299 R + 0.587 G + 0.114 B, to the
              ///< nearest integer
  red,
  green,
  blue,
  alpha,  ///< opacity
};

template <>
inline constexpr std::array names_of<Channel>{
    Named{Channel::automatic, "auto"}, Named{Channel::grey, "grey"}, Named{Channel::red, "red"},
    Named{Channel::green, "green"},    Named{Channel::blue, "blue"}, Named{Channel::alpha, "alpha"},
};

/// The layout of an image or of points in a file that does not describe it.
struct RawLayout {
  std::vector<Index> extents = {};  ///< sizes of the axes of an image, the last one fastest
  std::string type = "u1";          ///< as in NumPy: u1 u2 u4 u8 i1 i2 i4 i8 f2 f4 f8
  bool big_endian = false;          ///< the high byte comes first
  std::size_t skip = 0;             ///< bytes before the first number
  /// Numbers per point, if the file holds points; 0 for an image. Points have no extents.
  Index coordinates = 0;
};

/// Settings of the readers. The defaults refuse doubtful input, with an error that names the
/// setting.
struct ReadOptions {
  bool allow_empty = false;                      ///< an input without data gives an empty result
  Symmetrise symmetrise = Symmetrise::none;      ///< for square matrices
  bool from_correlation = false;                 ///< d = 1 - r; the diagonal must be 1
  Diagonal diagonal = Diagonal::zero;            ///< for square matrices
  NanPolicy nan = NanPolicy::error;              ///< see NanPolicy
  ArrayMeaning array = ArrayMeaning::automatic;  ///< used by read_any
  /// For tables: names of columns, numbers ("3") or ranges ("2-5"); empty: all columns.
  std::vector<std::string> columns = {};
  Channel channel = Channel::automatic;  ///< for pictures
  /// For meshes in read_any: vertices at the same position become one vertex.
  bool weld = false;
  /// For folders in read_any and read_image: the pictures in the folder are the slices of a volume.
  bool stack = false;
  std::optional<RawLayout> raw = {};  ///< used by read_any for Format::raw
  /// Budget and stop token for an input that is opened by its path; null if there are none. An open
  /// Input has its own context.
  const RunContext* context = nullptr;
  std::function<void(Message)> note = {};  ///< receives the reader's assumptions, one line each
  std::vector<Index>* dropped = nullptr;   ///< receives the rows that were left out, ascending
};

// Every reader takes a path ("-" is standard input) or an open Input. All readers throw these
// errors:
//
// - Error (bad_data): "name:line:column (or byte): what, found X, expected Y; hint".
// - Error (no_input): the file is missing, unreadable or a directory.
// - Error (io): reading failed partway, or there is no room for a temporary file.
// - Error (resource): the budget of the context would be exceeded.
// - Error (cancelled): a stop was requested.
// - Error (usage): options.columns names a missing column, or an option does not fit the input.
//
// The readers take linear time, and memory at most in proportion to the size of the input.

/// Points, one per line: numbers separated by blanks, commas or semicolons. A first row without any
/// number is skipped with a note. Also reads NPY (2-D), NPZ, PCD and PLY, recognised by content.
/// @return one point per row. An input without points is an error unless options.allow_empty.
Points read_points(const std::filesystem::path& path, const ReadOptions& options = {});
Points read_points(const Input& input, const ReadOptions& options = {});

/// A full square matrix: as many columns as rows, zero diagonal, symmetric (see Symmetrise);
/// +infinity means never joined. With options.from_correlation it is a correlation matrix; with
/// Diagonal::births its diagonal has the births of the points. Also reads NPY, NPZ and DIPHA's
/// distance matrices.
DistanceMatrix read_distances(const std::filesystem::path& path, const ReadOptions& options = {});
DistanceMatrix read_distances(const Input& input, const ReadOptions& options = {});

/// The strict lower triangle, row i with i numbers (the empty row 0 may be left out), or the entire
/// triangle on one line.
DistanceMatrix read_lower_distances(const std::filesystem::path& path,
                                    const ReadOptions& options = {});
DistanceMatrix read_lower_distances(const Input& input, const ReadOptions& options = {});

/// The strict upper triangle, row i with n-1-i numbers, or the entire triangle on one line (the
/// condensed form of SciPy).
DistanceMatrix read_upper_distances(const std::filesystem::path& path,
                                    const ReadOptions& options = {});
DistanceMatrix read_upper_distances(const Input& input, const ReadOptions& options = {});

/// The strict lower triangle as float32, little endian, without a header.
DistanceMatrix read_binary_distances(const std::filesystem::path& path,
                                     const ReadOptions& options = {});
DistanceMatrix read_binary_distances(const Input& input, const ReadOptions& options = {});

/// Pairs of points, one per line: `i j d`, ids from 0; the number of points is the largest id + 1.
/// A pair may be listed twice with the same distance. Also reads DIPHA's sparse distance matrices,
/// which state the number of points.
SparseDistances read_sparse(const std::filesystem::path& path, const ReadOptions& options = {});
SparseDistances read_sparse(const Input& input, const ReadOptions& options = {});

/// An array of any dimension from NPY, NPZ, PNG, PGM, TIFF, DIPHA, NIfTI, NRRD, MetaImage or
/// VTI, recognised by content. The axes are the axes of the file, in C order: a picture has (y, x),
/// the pages of TIFF have (z, y, x), and the volumes of the last five formats have (x, y, z).
/// With options.stack, the path is a folder, whose PNG, PGM or TIFF pictures of one kind are the
/// slices of a volume (z, y, x), in the natural order of their names: slice2 before slice10.
/// +-infinity is legal; NaN is an error or, with NanPolicy::drop, an absent voxel. An array that
/// would take more than a third of the memory left in the budget stays in its file, or in a
/// temporary file if its stored form differs from the form in memory; the file must not change
/// while the image exists. Arrays of an archive do not stay in the file.
Image read_image(const std::filesystem::path& path, const ReadOptions& options = {});
Image read_image(const Input& input, const ReadOptions& options = {});
/// NumPy's .npy: booleans, integers, floats (16, 32, 64 bits), both byte orders and both storage
/// orders; the result is in C order. Also reads an .npz that holds one array, or the array that
/// Input::member names ("scans.npz:brain").
Image read_npy_image(const Input& input, const ReadOptions& options = {});

/// NIfTI-1 in one file (.nii): integers and floats of up to 8 bytes, both byte orders, 1 to 7 axes,
/// of which trailing axes of size 1 are dropped; values are scaled by scl_slope and scl_inter.
Image read_nifti(const std::filesystem::path& path, const ReadOptions& options = {});
Image read_nifti(const Input& input, const ReadOptions& options = {});

/// The numbers of an image, one per voxel; apart from the bytes to skip, the file must hold nothing
/// else. @throws also Error (usage) on a layout without axes or with an unknown type.
Image read_raw(const Input& input, const RawLayout& layout, const ReadOptions& options = {});
/// Points without a header, layout.coordinates numbers each, as in the files of KITTI; apart from
/// the bytes to skip, the file must hold nothing else. options.columns chooses among these numbers.
/// @throws also Error (usage) on a layout without coordinates, with extents or with an unknown
/// type.
Points read_raw_points(const Input& input, const RawLayout& layout,
                       const ReadOptions& options = {});

/// An image with a list of the axes that close up on themselves.
struct PerseusImage {
  Image image;
  std::vector<bool> periodic;  ///< one per axis
};

/// Perseus' cubical text. Either a grid: dimension, a size for each axis (negative: periodic, as in
/// GUDHI), the values with the first axis fastest. Or a list of cubes: dimension, then one cube per
/// line with its coordinates, counted from 0, and its value; other cubes never enter. A cube with
/// the value -1 never enters if all other values are positive integers, as in Perseus; otherwise,
/// -1 is an ordinary value, as in GUDHI. A note states which rule applies.
PerseusImage read_perseus(const std::filesystem::path& path, const ReadOptions& options = {});
PerseusImage read_perseus(const Input& input, const ReadOptions& options = {});

/// Simplices with values, and the line of the file on which each simplex stands.
struct SimplicesInput {
  SimplexList simplices;
  std::vector<std::size_t> lines;  ///< simplex i is on lines[i], from 1
  std::string name;                ///< printable name of the file
  /// Values on the vertices 0, 1, …, from a separate file (read_any); otherwise empty.
  std::vector<double> vertex_values;

  /// Names a simplex in messages as "name:line". The result may outlive this object.
  CellNamer namer() const;
};

/// Simplices `v0 v1 … : value`, one per line in any order; a value may be infinite but not NaN.
SimplicesInput read_simplices(const std::filesystem::path& path, const ReadOptions& options = {});
SimplicesInput read_simplices(const Input& input, const ReadOptions& options = {});

/// A boundary matrix with the place of each column in its file.
struct BoundaryInput {
  BoundaryMatrix matrix;
  /// places[i] is the line of column i (text, from 1) or its byte offset (binary).
  std::vector<std::size_t> places;
  bool binary = false;
  std::string name;  ///< printable name of the file

  CellNamer namer() const;
};

/// PHAT's boundary matrices over Z/2. The text has one cell per line: its dimension, then the
/// indices of its facets. The binary form has int64 numbers, little endian: the number of cells,
/// then for each cell its dimension, the number of its facets, and the facets. Indices count from 0
/// and name earlier columns, ascending. Also reads DIPHA's weighted boundary matrices, whose
/// columns may be in any order.
/// @param values_path a file with one value per cell: text, or float64 little endian; if empty, the
/// value of a cell is its position.
BoundaryInput read_phat(const std::filesystem::path& path,
                        const std::filesystem::path& values_path = {},
                        const ReadOptions& options = {});
BoundaryInput read_phat(const Input& input, const ReadOptions& options = {});

/// Reads `count` numbers, as text or as raw float64 little endian. @param owner names, in messages,
/// the things that have one number each. @throws Error (bad_data) if there are more or fewer
/// numbers, or on a NaN.
std::vector<double> read_values(const Input& input, std::size_t count,
                                const ReadOptions& options = {}, std::string_view owner = "cell");

/// A polygon mesh: face f has the vertices corners[offsets[f] … offsets[f+1]).
struct Mesh {
  Points vertices;  ///< one per row, three columns
  std::vector<Index> corners;
  std::vector<std::size_t> offsets{0};
  std::vector<double> values;  ///< one per vertex, or empty

  std::size_t faces() const { return offsets.empty() ? 0 : offsets.size() - 1; }
};

/// OFF (Geomview), text. @throws Error (bad_data) also on a face that names a missing vertex.
Mesh read_off(const std::filesystem::path& path, const ReadOptions& options = {});
Mesh read_off(const Input& input, const ReadOptions& options = {});
/// The vertices and faces of a PLY file; cloud.hpp reads clouds with all their fields.
Mesh read_ply_mesh(const std::filesystem::path& path, const ReadOptions& options = {});
Mesh read_ply_mesh(const Input& input, const ReadOptions& options = {});

/// The input formats, in the order of the programs' `--format` option.
enum class Format {
  automatic,  ///< decided by content and extension
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
  tiff,
  perseus,
  nifti,
  nrrd,
  metaimage,
  vti,
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

/// The result of reading any format.
struct ReadResult {
  std::variant<Points, DistanceMatrix, SparseDistances, Image, SimplicesInput, BoundaryInput, Mesh>
      data;
  Format format = Format::automatic;  ///< never `automatic` in a result
  std::string description;            ///< such as "1024 points in R^3, CSV"
  std::vector<Message> notes;         ///< assumptions, such as "line 1 is a header: skipped"
  /// For Points: row i is point point_ids[i] of the input. If empty, row i is point i: no point was
  /// left out. For a welded Mesh: vertex i is vertex point_ids[i] of the input, the first one at
  /// its position.
  std::vector<Index> point_ids;
  /// For an Image: true for each axis that closes up on itself, according to the file. Empty if no
  /// axis does.
  std::vector<bool> periodic;
  /// For an Image: the places of its voxels in space, if the file (NIfTI, NRRD, MetaImage, VTI)
  /// states them.
  std::optional<Affine> affine;
};

/// One line of the table of formats: a name, a description, and a line of an example.
struct FormatInfo {
  Format format;
  std::string_view name;     ///< "points"
  std::string_view marked;   ///< the description with its marks
  std::string_view example;  ///< "0.5 1.25 -3e-2"
  /// The reader; null if the format is not built in.
  ReadResult (*read)(const Input&, const ReadOptions&);

  /// "one point per line: numbers separated by blanks or commas"
  Message description() const { return marked; }
};

/// All formats. To add a format, write a function and a line of this table.
std::span<const FormatInfo> formats();
const FormatInfo& format_info(Format format);
/// The format that a value of `--format` names ("lower-distance").
std::optional<Format> format_from_name(std::string_view name);

/// Detects the format by magic numbers, then by extension, then by the shape of the first lines.
/// Never returns Format::automatic; a text of numbers counts as `points` unless there is other
/// evidence. No options are considered here, but read_any considers its options to learn more about
/// text.
Format detect_format(const Input& input);

/// Reads any format.
/// @param path "-" is standard input; with options.stack, a folder. @param format with
/// Format::automatic, see detect_format.
/// @param values_path a file with the values of the cells of a boundary matrix, or of the vertices
///        of a mesh or of simplices; empty: none. @throws Error as the readers do; Error
///        (not_built_in) if the format is not built in; Error (usage) if values are given for a
///        format that takes none.
ReadResult read_any(const std::filesystem::path& path, Format format = Format::automatic,
                    const ReadOptions& options = {}, const std::filesystem::path& values_path = {});
ReadResult read_any(const Input& input, Format format = Format::automatic,
                    const ReadOptions& options = {}, const std::filesystem::path& values_path = {});

}  // namespace ph
