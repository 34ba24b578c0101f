// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/detail/io/cloud_data.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/io/read.hpp"

namespace ph::detail {

struct TableLayout;

/// A table of numbers that was read from a text. All rows have the same length.
struct TextTable {
  Points rows;
  std::vector<std::string> header;  ///< the cells of a first line without numbers, or empty
};

/// Reads an entire table. @param allow the cells that may occur in addition to finite numbers.
/// @param counted true if the first line is the number of rows. @param layout the columns to read;
/// if null, all columns are read, and a first line of names is a header.
TextTable read_text_table(const Input& input, Allow allow, const ReadOptions& options,
                          bool counted = false, const TableLayout* layout = nullptr);
/// Reads a table as an image, with one row of pixels per line. A single row or column becomes an
/// image with one axis.
Image read_grid(const Input& input, const ReadOptions& options);

/// Adds a note if the first column was read as data but may be an index, or if the first row was
/// read as data but may be a header.
void tell_of_counts(const Input& input, const TableLayout& layout, PointsView rows,
                    const ReadOptions& options);
/// Adds a note if points without a header have three columns of fractions and then only columns of
/// whole numbers, such as an intensity, a colour or a label.
void tell_of_whole_columns(PointsView points, const ReadOptions& options);
/// Adds a note for columns whose names are not names of coordinates, for latitudes and longitudes
/// and, without a header, for columns of whole numbers.
void tell_of_columns(const TableLayout& layout, PointsView rows, const ReadOptions& options);

/// Depending on options.nan, either removes the rows with a NaN and reports these rows, or throws.
/// @param holes true if rows with a NaN are holes of a point cloud, which are always removed.
Points without_nan_rows(Points points, const Input& input, const ReadOptions& options, bool holes);

/// Converts a square array to distances; see read_distances.
DistanceMatrix square_to_distances(const Image& array, const Input& input,
                                   const ReadOptions& options);

/// A pair of points with the line or byte where it was found.
struct LocatedEdge {
  WeightedEdge edge;
  std::size_t place = 0;
};
/// Sorts pairs u < v, and removes repeated pairs and pairs with an infinite distance. If a pair is
/// listed twice with different distances, calls `fail(place, fault)`, which throws.
std::vector<WeightedEdge> unique_edges(std::vector<LocatedEdge> pairs, const Input& input,
                                       const std::function<void(std::size_t, const Fault&)>& fail);

/// Each of these functions returns true if the input has the magic number of the format.
bool is_npy(const Input& input);
bool is_pcd(const Input& input);
bool is_ply(const Input& input);
bool is_png(const Input& input);
bool is_off(const Input& input);
bool is_npz(const Input& input);
bool is_pgm(const Input& input);
bool is_nifti(const Input& input);
/// The places of the voxels of a NIfTI file; empty if its numbers are not finite.
std::optional<Affine> nifti_affine(const Input& input);
bool is_dipha(const Input& input);
bool is_nrrd(const Input& input);
bool is_tiff(const Input& input);
bool is_meta_image(const Input& input);
/// True for an XML text whose first element is a VTKFile of type ImageData.
bool is_vti(const Input& input);

/// True if the first bytes contain no control characters except tabs and line ends, and are mostly
/// UTF-8. Binary formats begin with an eight-byte count. A count below 2^40 contains NUL bytes,
/// which do not occur in text.
bool is_text(std::string_view bytes);

/// Refuses bytes that are not text and have no magic number. @param hint advice for bytes of an
/// unknown kind.
void refuse_bytes(const Input& input, std::string_view hint);
/// The settings that read numbers without a header, for a message.
std::string way_to_raw();

/// The setting that reads a file of float32 as points of 4, 3, 5 or 6 numbers, for a message; empty
/// if its size fits none of them.
std::string way_to_raw_points(const Input& input);

/// True if the first line of a set of points is the number of points, as in PTS.
bool is_counted(const Input& input);

/// Reads an NPY, or the array of an NPZ, without changes. NaN values are kept.
Image read_npy_array(const Input& input, Input::Excess excess = Input::Excess::refused);
/// True if an NPY contains floats. Precondition: the input is an NPY.
bool is_npy_of_floats(const Input& input);
/// Throws Error (bad_data), because a file has not the array that input.member() names or, without
/// such a name, has not exactly one array. @param names its arrays, printable. @param whole "the
/// archive".
[[noreturn]] void refuse_members(const Input& input, std::vector<std::string> names,
                                 std::string_view whole);
/// The only array of an NPZ, or the array that input.member() names, unpacked.
Input read_npz_member(const Input& input);

/// Makes an image from a PNG, with one number per pixel. The channel is chosen by options.channel.
Image image_of(Raster raster, const Input& input, const ReadOptions& options);
/// Throws Error (bad_data), because a picture of this kind does not have the channel.
[[noreturn]] void refuse_channel(Channel channel, std::string_view kind, const Input& input);
Image read_png_image(const Input& input, const ReadOptions& options);
/// Reads a TIFF or BigTIFF file. Several pages become a volume with the axes (z, y, x).
Image read_tiff_image(const Input& input, const ReadOptions& options);
Image read_pgm_image(const Input& input);

/// An image with the places of its voxels in space, if the file states them.
struct Volume {
  Image image;
  std::optional<Affine> affine;
};

/// Reads an NRRD file. The numbers may be in another file, which the header names.
Volume read_nrrd(const Input& input, const ReadOptions& options);
/// Reads a MetaImage, the format of ITK. The numbers may be in another file, which the header
/// names.
Volume read_meta_image(const Input& input, const ReadOptions& options);

/// The name of the file that holds the numbers of an NRRD file, if its header names one. @throws
/// Error (bad_data) if the header is damaged.
std::optional<std::string> nrrd_data_file(const Input& input);
/// The same for a MetaImage.
std::optional<std::string> meta_image_data_file(const Input& input);

/// Reads an array of a VTI file, the images of VTK: the array that input.member() names, the only
/// array, or the array that the file marks as its scalars.
Volume read_vti(const Input& input, const ReadOptions& options);

/// A volume whose slices are pictures.
struct Stack {
  Image image;
  Format format;          ///< the format of the slices
  std::string_view kind;  ///< its name, for people
};

/// Reads the pictures in a folder (see Input::of_folder) as the slices of a volume (z, y, x).
/// @param format png, pgm or tiff, or automatic if the folder has pictures of only one of them.
/// @throws Error (usage) for another format.
Stack read_stack(const Input& folder, Format format, const ReadOptions& options);
/// The names of the slices in a folder, in their order. The parameters and errors are those of
/// read_stack.
std::vector<std::string> slices_in(const Input& folder, Format format);

/// The type of a DIPHA file, which is the number after the magic number.
enum class DiphaType : std::int64_t {
  boundary_matrix = 0,
  image = 1,
  diagram = 2,
  distance_matrix = 7,
  sparse_distance_matrix = 8,
};
constexpr std::int64_t kDiphaMagic = 8067171840;
/// Reads the type of a DIPHA file. @throws Error (bad_data) on another magic number or an unknown
/// type.
DiphaType dipha_type(const Input& input);

// Each of these functions reads a DIPHA file of one type. @throws Error (bad_data) if the file is
// damaged or has another type.
Image read_dipha_image(const Input& input, const ReadOptions& options);
DistanceMatrix read_dipha_distances(const Input& input, const ReadOptions& options);
SparseDistances read_dipha_sparse(const Input& input, const ReadOptions& options);
BoundaryInput read_dipha_boundary(const Input& input, const ReadOptions& options);

/// Depending on options.nan, either marks NaN as absent voxels or throws. An image without voxels
/// is an error unless options.allow_empty is set.
Image without_nan_pixels(Image image, const Input& input, const ReadOptions& options);

/// A note on vertices at the same position that belong to faces; empty if there are none.
std::string note_on_seams(const Mesh& mesh, const Input& input);
/// Makes one vertex of all vertices at the same position. @return for each remaining vertex, its
/// number before. @throws Error (bad_data) if such vertices have different values.
std::vector<Index> weld(Mesh& mesh, const Input& input);

/// Renames fields X, Y and Z to x, y and z, unless the cloud has such fields.
void name_coordinates(Cloud& cloud);

/// Converts the numbers of a cloud between little endian and this machine's byte order.
void to_native(Cloud& cloud);

/// Checks the budget before a full vector grows.
template <class T>
void require_growth(const Input& input, const std::vector<T>& vector) {
  if (vector.size() == vector.capacity()) input.require_memory(2 * vector.size() * sizeof(T));
}

/// Passes a message to options.note, if it is set.
inline void note(const ReadOptions& options, Message text) {
  if (options.note) options.note(std::move(text));
}

}  // namespace ph::detail
