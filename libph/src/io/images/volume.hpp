// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/tables/array.hpp"

namespace ph::detail {

/// A field in the header of a volume: a line with a name and a value.
struct HeaderField {
  std::string_view name;   ///< as it is written
  std::string_view value;  ///< without the blanks around it
  std::size_t line = 0;    ///< the number of the line, from 1
  std::size_t column = 0;  ///< the column of the value, from 1
};

/// The header of a volume: lines of text at the start of a file, of which some are fields.
class VolumeHeader {
 public:
  explicit VolumeHeader(const Input& input) : input_(input) {}

  /// Goes to the next line. @return false at the end of the file.
  bool next_line();
  /// The current line, without its line end.
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  ///< the number of the current line, from 1
  std::size_t offset() const { return offset_; }  ///< the first byte after the current line

  /// Adds the current line as a field. @param key the name by which it is found. @param mark the
  /// place of the character, or of the two characters, between the name and the value.
  /// @throws Error (bad_data) if there is a field with this key.
  const HeaderField& add(const std::string& key, std::size_t mark);
  /// The field with this key; null if there is none.
  const HeaderField* find(const std::string& key) const;
  /// @throws Error (bad_data) if there is no field with this key.
  const HeaderField& need(const std::string& key) const;

  /// The words of a value, separated by blanks.
  static std::vector<std::string_view> words(const HeaderField& field);
  /// The numbers of a value. @param least @param most the smallest and the largest of them that is
  /// allowed. @throws Error (bad_data).
  std::vector<std::int64_t> integers(const HeaderField& field, std::int64_t least,
                                     std::int64_t most) const;
  std::int64_t integer(const HeaderField& field, std::int64_t least, std::int64_t most) const;
  /// The numbers in a text, which may be infinite or NaN. @throws Error (bad_data).
  std::vector<double> numbers(const HeaderField& field, std::string_view text) const;
  /// Throws Error (bad_data) at the value of a field, which is what was found.
  [[noreturn]] void fail(const HeaderField& field, std::string_view expected,
                         const Message& hint = {}) const;

  const Input& input() const { return input_; }

 private:
  const Input& input_;
  std::size_t offset_ = 0, number_ = 0;
  std::string_view line_;
  std::map<std::string, HeaderField> fields_;
};

/// The way in which the numbers of a volume are stored.
enum class VolumeEncoding { raw, packed, text };

/// A volume as its header describes it. The first axis varies fastest.
struct StoredVolume {
  std::string_view kind;  ///< the type of the numbers, as for element_type
  std::endian order = std::endian::little;
  std::vector<Index> extents;
  std::optional<Affine> affine;
  VolumeEncoding encoding = VolumeEncoding::raw;
  const HeaderField* file = nullptr;  ///< the field that names the file of the data, if any
  std::size_t offset = 0;             ///< the start of the data; 0 in a file of their own
  std::size_t lines = 0;              ///< lines to skip there
  std::size_t skip = 0;               ///< bytes to skip after them; in packed data, once unpacked
  std::size_t packed_size = 0;        ///< the stated size of packed data; 0: not stated
  bool at_end = false;                ///< raw data: the data are the last bytes of the file
};

/// An affine map from vectors between neighbours along the axes and the place of the first voxel.
/// Vectors with two coordinates lie in the plane of the first two. A vector that is missing is
/// perpendicular to the others and has length 1. @return nothing if a number is not finite.
/// @param signs the signs of the coordinates in the result.
std::optional<Affine> affine_of(const std::vector<std::vector<double>>& vectors,
                                const std::vector<double>& origin,
                                const std::array<double, 3>& signs);

/// The note on an affine map that is not used.
constexpr std::string_view kNoPlaces =
    "the places of the voxels are not used, because they are no finite numbers";

/// The number of bytes that the numbers take, unless it exceeds size_t.
std::optional<std::size_t> bytes_of(const StoredVolume& volume, std::size_t each);
/// Drops the axes of size 1 after the last other one.
void drop_last_axes(std::vector<Index>& extents);
/// Reads the numbers of a volume from the input that contains them.
Image load_numbers(const Input& data, const StoredVolume& volume);
/// Reads the numbers of a volume. Trailing axes of size 1 are dropped.
Volume load_volume(const VolumeHeader& header, StoredVolume volume, const ReadOptions& options);

}  // namespace ph::detail
