// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/image.hpp"
#include "ph/io/read.hpp"

namespace ph::detail {

/// The type of the numbers in a stored array.
struct ElementType {
  std::size_t size = 0;  ///< size in bytes
  /// Loads the number at an address. Sets the last argument to false if double cannot represent the
  /// number.
  double (*load)(const std::byte*, std::endian, bool&) = nullptr;
  VoxelType stored = VoxelType::float64;  ///< the smallest type of voxels that holds all its values
  bool is_native = false;  ///< true if `stored` is this type itself, apart from byte order
};

/// The type with this name, which is NumPy's letter and the size in bytes. The names are b1 u1 u2
/// u4 u8 i1 i2 i4 i8 f2 f4 f8. Returns nothing for any other name.
std::optional<ElementType> element_type(std::string_view kind);

/// The layout of an array in a file.
struct ArrayLayout {
  ElementType type;
  std::endian order = std::endian::little;
  bool first_axis_fastest = false;  ///< true as in Fortran, DIPHA and NIfTI; false as in C
  std::size_t offset = 0;           ///< the offset of the first element
};

/// The content of an NPY header, checked against the file.
struct NpyLayout {
  ArrayLayout array;
  std::vector<Index> shape;
  char kind = 'f';        ///< the letter that NumPy uses for the type: b, u, i or f
  std::size_t count = 0;  ///< the number of elements, which are all present
};
/// Reads the header of an NPY. @throws Error (bad_data) if the input is not an NPY file, or has a
/// different number of elements than it states.
NpyLayout npy_layout(const Input& input);

/// True if data made from an input should stay in a file. This is the case if the data, which have
/// `bytes` bytes, are larger than 1 MiB and need more than a third of the remaining memory, or if
/// the input itself stays in a file.
bool stays_in_file(const Input& input, std::size_t bytes);

/// Counts the elements of an array. They must end exactly at the end of the input.
/// @throws Error (bad_data) "truncated" or "trailing data".
std::size_t count_elements(const Input& input, const ArrayLayout& layout,
                           const std::vector<Index>& extents);

/// Reads an array whose elements end at the end of the input (see count_elements). The result is in
/// C order.
/// @param excess with Excess::stays_in_file, voxels for which the function stays_in_file() returns
/// true stay in the input's file, or in a temporary file if they must be converted.
/// @throws Error (bad_data) on an integer that double cannot represent; Error (resource); Error
/// (io).
Image load_array(const Input& input, const ArrayLayout& layout, std::vector<Index> extents,
                 Input::Excess excess = Input::Excess::refused);
/// The same for an array that may be followed by other bytes. Precondition: the elements are
/// present.
Image load_elements(const Input& input, const ArrayLayout& layout, std::vector<Index> extents,
                    Input::Excess excess);

/// The rows of an array with two axes as points: those of its columns that options.columns chooses.
/// @throws Error (bad_data) on a number that is not finite; see NanPolicy. Error (resource).
Points points_of_array(const Image& array, const Input& input, const ReadOptions& options);

/// Numbers in a temporary file. They are zero until `fill(std::span<T>)` writes them.
template <VoxelNumber T, class Fill>
Voxels voxels_in_file(VoxelType type, std::size_t count, Fill&& fill) {
  auto file = std::make_shared<ScratchFile>(count * sizeof(T));
  fill(std::span<T>(reinterpret_cast<T*>(file->data()), count));
  forget_file_pages(file->data(), file->size());
  return Voxels(BorrowedVoxels{type, file->data(), count, file, true});
}

/// Visits the elements of an array with the first axis fastest, and gives the position of each
/// element in C order.
class FirstAxisFastest {
 public:
  explicit FirstAxisFastest(const std::vector<Index>& extents);
  std::size_t place() const { return place_; }
  void next();

 private:
  struct Axis {
    std::size_t extent, stride, at;
  };
  std::vector<Axis> axes_;
  std::size_t place_ = 0;
};

}  // namespace ph::detail
