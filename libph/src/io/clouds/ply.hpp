// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/cloud_data.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::detail {

struct PlyProperty {
  std::string name;
  FieldType type = FieldType::float32;
  std::optional<FieldType> length_type;  ///< the type of a list's length; a scalar has none
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool ascii = false;
  std::endian order = std::endian::little;
  std::vector<PlyElement> elements;
  std::size_t offset = 0;  ///< the start of the data in the file
  std::size_t lines = 0;   ///< the number of lines before the data
};

/// Reads the header of a PLY file. @throws Error (bad_data) if it is invalid.
PlyHeader read_ply_header(const Input& input);

/// Reads the values after a header one after another, as text or binary.
class PlyBody {
 public:
  /// Keeps references to the input and the header.
  PlyBody(const Input& input, const PlyHeader& header);

  /// Checks the element's count against the bytes that follow. Elements must be read in the file's
  /// order.
  void start_element(const PlyElement& element);
  void start_row(std::size_t row);
  void end_row();
  /// Reads one value and stores it at `to` in this machine's byte order.
  void scalar(FieldType type, std::byte* to);
  double number(FieldType type);
  std::size_t list_length(const PlyProperty& property);
  void skip_list(const PlyProperty& property);
  void skip_element();
  /// Returns the bytes of several rows at once. Only for binary files.
  std::span<const std::byte> raw_rows(std::size_t bytes);
  /// Must be called after the last element. @throws Error (bad_data) if more data follow.
  void expect_end();

 private:
  const Input& input_;
  const PlyHeader& header_;
  TextLines lines_;
  Cells cells_;
  BinaryCursor cursor_;
  const PlyElement* element_ = nullptr;
};

}  // namespace ph::detail
