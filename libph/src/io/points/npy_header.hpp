// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libph/src/io/tables/array.hpp"
#include "ph/detail/io/cloud_data.hpp"

namespace ph::detail {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

/// A type of numbers in an NPY file.
struct NpyType {
  ElementType element;
  std::endian order = std::endian::little;
  char kind = 'f';  ///< the letter that NumPy uses for the type: b, u, i or f
};
/// The type with this name, such as "<f4"; nothing if its numbers are not read.
std::optional<NpyType> npy_type(std::string_view descr);

/// A field of the records of a structured array.
struct NpyField {
  std::string name;             ///< empty for padding
  std::optional<NpyType> type;  ///< nothing for strings, padding and other types that are not read
  std::size_t count = 1;        ///< numbers per record
  std::size_t offset = 0;       ///< the offset of the first of them in a record
};

/// The header of an NPY file.
struct NpyHeader {
  std::string descr = {};  ///< the type of the numbers; empty for a structured array
  std::vector<NpyField> fields = {};
  std::size_t record = 0;  ///< bytes of a record of a structured array
  bool fortran_order = false;
  std::vector<Index> shape = {};
  std::size_t offset = 0;  ///< the start of the data
};
/// @throws Error (bad_data) if the input is not an NPY file or its header is damaged.
NpyHeader read_npy_header(const Input& input);

/// The names of the fields, for a message.
std::string names_of_fields(const std::vector<NpyField>& fields);

/// True if an NPY holds a structured array. Precondition: the input is an NPY.
bool is_npy_of_records(const Input& input);
/// The coordinates of points from a structured array, one point per record: the fields that
/// options.columns names; otherwise x, y and z; otherwise all fields, if they are floats. Notes say
/// which fields are left out.
/// @throws Error (bad_data) on other fields, or if the file has more or fewer records.
Points points_of_records(const Input& input, const ReadOptions& options);
/// All fields of a structured array as a cloud. If it has three fields of one float each that are
/// not named x, y and z, these are the coordinates.
Cloud cloud_of_records(const Input& input, const ReadOptions& options);

}  // namespace ph::detail
