// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/detail/io/cloud_data.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/io/read.hpp"

namespace ph::detail {

struct TableLayout;

/// Rows of numbers of one length, as text has them.
struct TextTable {
  Points rows;
  std::vector<std::string> header;  ///< the cells of a first line without numbers, or empty
};

/// Reads a whole table. @param allow what cells may hold besides finite numbers.
/// @param counted the first line is the number of rows. @param layout which columns are read;
/// null: all, behind a first line of names, if there is one.
TextTable read_text_table(const Input& input, Allow allow, const ReadOptions& options,
                          bool counted = false, const TableLayout* layout = nullptr);
/// A table as an image: a row of pixels a line. One row or one column is an image of one axis.
Image read_grid(const Input& input, const ReadOptions& options);

/// Takes the rows with a NaN out, or throws, as options.nan says; reports what it drops.
/// @param holes rows with a NaN are holes of a point cloud: they are left out in any case.
Points without_nan_rows(Points points, const Input& input, const ReadOptions& options, bool holes);

/// A square array as distances; see read_distances.
DistanceMatrix square_to_distances(const Image& array, const Input& input,
                                   const ReadOptions& options);

/// A pair of points with where it was found: a line, or a byte.
struct LocatedEdge {
  WeightedEdge edge;
  std::size_t place = 0;
};
/// The pairs u < v, each once, sorted, without infinite ones. A pair listed again with another
/// distance is reported to `fail(place, fault)`, which throws.
std::vector<WeightedEdge> unique_edges(std::vector<LocatedEdge> pairs, const Input& input,
                                       const std::function<void(std::size_t, const Fault&)>& fail);

/// The magic numbers.
bool is_npy(const Input& input);
bool is_pcd(const Input& input);
bool is_ply(const Input& input);
bool is_png(const Input& input);
bool is_off(const Input& input);
bool is_npz(const Input& input);
bool is_pgm(const Input& input);
bool is_nifti(const Input& input);
bool is_dipha(const Input& input);

/// Whether bytes begin like text, without those below the tab: eight bytes of a count below 2^40
/// have several.
bool is_text(std::string_view bytes);

/// A set of points whose first line is their number, as PTS has it.
bool is_counted(const Input& input);

/// NPY as it is, or the array of an NPZ: NaN and all.
Image read_npy_array(const Input& input, Input::Excess excess = Input::Excess::refused);
/// Whether an NPY has floats; precondition: it is one.
bool is_npy_of_floats(const Input& input);
/// The one array of an NPZ, or the one that input.member() names, unpacked.
Input read_npz_member(const Input& input);

/// One number a pixel of a PNG; takes options.channel.
Image image_of(Raster raster, const Input& input, const ReadOptions& options);
Image read_png_image(const Input& input, const ReadOptions& options);
Image read_pgm_image(const Input& input);

/// What a DIPHA file holds: the number that follows its magic number.
enum class DiphaType : std::int64_t {
  boundary_matrix = 0,
  image = 1,
  diagram = 2,
  distance_matrix = 7,
  sparse_distance_matrix = 8,
};
constexpr std::int64_t kDiphaMagic = 8067171840;
/// @throws Error (bad_data) on another magic number or an unknown type.
DiphaType dipha_type(const Input& input);

// Each reads a DIPHA file of its type. @throws Error (bad_data), also on another type.
Image read_dipha_image(const Input& input, const ReadOptions& options);
DistanceMatrix read_dipha_distances(const Input& input, const ReadOptions& options);
SparseDistances read_dipha_sparse(const Input& input, const ReadOptions& options);
BoundaryInput read_dipha_boundary(const Input& input, const ReadOptions& options);

/// Takes NaN as the mark of absent voxels or throws, as options.nan says; an image without voxels
/// is an error unless options.allow_empty.
Image without_nan_pixels(Image image, const Input& input, const ReadOptions& options);

/// Brings the little-endian numbers of a record to this machine's byte order.
void to_native(Cloud& cloud);

/// Asks the budget before a vector that is full is about to grow.
template <class T>
void require_growth(const Input& input, const std::vector<T>& vector) {
  if (vector.size() == vector.capacity()) input.require_memory(2 * vector.size() * sizeof(T));
}

/// Says something to options.note, if it is there.
inline void note(const ReadOptions& options, Message text) {
  if (options.note) options.note(std::move(text));
}

}  // namespace ph::detail
