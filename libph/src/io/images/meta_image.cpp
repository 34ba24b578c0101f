// SPDX-License-Identifier: MIT
// Reads MetaImage, the format of ITK: a header of text, then the numbers, in the same file (.mha)
// or another one (.mhd).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "libph/src/io/bytes/unpack.hpp"
#include "libph/src/io/images/volume.hpp"
#include "ph/detail/core/lower_case.hpp"

namespace ph::detail {
namespace {

using namespace std::string_view_literals;

constexpr std::int64_t kMostMetaAxes = 10;  // the limit of ITK
constexpr std::int64_t kMostMeta = std::numeric_limits<std::int64_t>::max();

struct MetaType {
  std::string_view name, kind;  // the kind is a name as for element_type
};
constexpr std::array kMetaTypes{
    MetaType{"MET_CHAR", "i1"},       MetaType{"MET_UCHAR", "u1"}, MetaType{"MET_SHORT", "i2"},
    MetaType{"MET_USHORT", "u2"},     MetaType{"MET_INT", "i4"},   MetaType{"MET_UINT", "u4"},
    MetaType{"MET_LONG", "i4"},       MetaType{"MET_ULONG", "u4"}, MetaType{"MET_LONG_LONG", "i8"},
    MetaType{"MET_ULONG_LONG", "u8"}, MetaType{"MET_FLOAT", "f4"}, MetaType{"MET_DOUBLE", "f8"}};

// Fields with several names, of which the first is used here.
constexpr std::array<std::array<std::string_view, 3>, 3> kMetaNames{
    {{"Offset", "Position", "Origin"},
     {"TransformMatrix", "Rotation", "Orientation"},
     {"ElementByteOrderMSB", "BinaryDataByteOrderMSB", "BinaryDataByteOrderMSB"}}};

// Fields that the reader uses, then fields that change neither the numbers nor their places.
constexpr std::array kMetaFields{"ObjectType"sv,
                                 "NDims"sv,
                                 "DimSize"sv,
                                 "ElementType"sv,
                                 "ElementDataFile"sv,
                                 "ElementByteOrderMSB"sv,
                                 "BinaryData"sv,
                                 "CompressedData"sv,
                                 "CompressedDataSize"sv,
                                 "HeaderSize"sv,
                                 "ElementNumberOfChannels"sv,
                                 "ElementSpacing"sv,
                                 "Offset"sv,
                                 "TransformMatrix"sv,
                                 "ObjectSubType"sv,
                                 "Comment"sv,
                                 "Name"sv,
                                 "ID"sv,
                                 "ParentID"sv,
                                 "Color"sv,
                                 "Modality"sv,
                                 "AnatomicalOrientation"sv,
                                 "CenterOfRotation"sv,
                                 "DistanceUnits"sv,
                                 "AcquisitionDate"sv,
                                 "ElementSize"sv,
                                 "ElementMin"sv,
                                 "ElementMax"sv,
                                 "ElementNBits"sv,
                                 "ElementDataType"sv,
                                 "SequenceID"sv,
                                 "ImagePosition"sv};

bool is_word(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (to_lower(c) >= 'a' && to_lower(c) <= 'z') || (c >= '0' && c <= '9');
  });
}

class MetaImage {
 public:
  MetaImage(const Input& input, const ReadOptions& options) : header_(input), options_(options) {}

  /// The name of the file of the data, if the data are not in the file of the header.
  std::optional<std::string> data_file() {
    read_fields();
    if (volume_.file == nullptr) return std::nullopt;
    return std::string(volume_.file->value);
  }

  Volume read() {
    read_fields();
    if (const HeaderField* const kind = find("ObjectType"); kind && kind->value != "Image")
      header_.fail(*kind, "Image", "objects of other kinds have no voxels");
    const auto axes =
        static_cast<std::size_t>(header_.integer(header_.need("NDims"), 1, kMostMetaAxes));
    const HeaderField& sizes = header_.need("DimSize");
    volume_.extents = header_.integers(sizes, 1, kMostMeta);
    if (volume_.extents.size() != axes)
      header_.fail(sizes, fmt::format("{} sizes, because NDims is {}", axes, axes));
    if (const HeaderField* const channels = find("ElementNumberOfChannels");
        channels && header_.integer(*channels, 1, kMostMeta) != 1)
      header_.fail(*channels, "1, because an image has one number per voxel",
                   "save one channel, or save it as .npy and take one, a[..., 0]");
    const HeaderField& type = header_.need("ElementType");
    const auto* const known = std::ranges::find(kMetaTypes, type.value, &MetaType::name);
    if (known == kMetaTypes.end())
      header_.fail(type, "a type of integers or floats, such as MET_UCHAR, MET_SHORT or MET_FLOAT");
    volume_.kind = known->kind;
    set_data();
    set_places(axes);
    return load_volume(header_, volume_, options_);
  }

 private:
  const HeaderField* find(const char* key) const { return header_.find(key); }

  // Reads the lines up to the field ElementDataFile, which is the last one.
  void read_fields() {
    const Input& input = header_.input();
    for (std::string key; key != "ElementDataFile";) {
      if (!header_.next_line()) {
        input.fail_at_byte(input.size(), {"truncated in the header of a MetaImage",
                                          "the end of the file",
                                          "the field ElementDataFile",
                                          {}});
      }
      const std::string_view line = header_.line();
      if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
      const std::size_t equals = line.find('=');
      const bool has_value = equals != std::string_view::npos;
      if (has_value)
        key = line.substr(0, std::min(line.find_last_not_of(" \t", equals - 1) + 1, equals));
      if (header_.number() == 1 && (!has_value || !is_word(key)))
        input.fail_at_byte(0, {"not a MetaImage file",
                               '"' + printable(line.substr(0, 20)) + '"',
                               "a header that begins with ObjectType = Image",
                               {}});
      if (!has_value)
        input.fail_at(
            header_.number(), 1,
            {"header of a MetaImage", '"' + printable(line, 40) + '"', "a line FIELD = VALUE", {}});
      for (const auto& names : kMetaNames)
        if (std::ranges::count(names, key) > 0) key = names[0];
      header_.add(key, equals);
      if (std::ranges::count(kMetaFields, key) == 0)
        note(options_, fmt::format("line {}: the field {} is not used", header_.number(),
                                   printable(key, 40)));
    }
    const HeaderField& file = header_.need("ElementDataFile");
    if (lower_case(file.value) == "local") {
      volume_.offset = header_.offset();
      return;
    }
    constexpr std::string_view kWayOut = "join the slices in one file, or save the array as .npy";
    if (file.value == "LIST" || file.value.starts_with("LIST ") ||
        file.value.find('%') != std::string_view::npos || file.value.empty())
      header_.fail(file, "LOCAL or one file", std::string(kWayOut));
    volume_.file = &file;
    if (header_.offset() != input.size())
      input.fail_at_byte(header_.offset(),
                         {"trailing data",
                          fmt::format("{} more bytes", input.size() - header_.offset()),
                          "the end of the header, because the data are in another file",
                          {}});
  }

  bool is_true(const char* key, bool otherwise) const {
    const HeaderField* const field = find(key);
    if (field == nullptr) return otherwise;
    const std::string word = lower_case(field->value);
    if (word == "true" || word == "1") return true;
    if (word != "false" && word != "0") header_.fail(*field, "True or False");
    return false;
  }

  void set_data() {
    volume_.order = is_true("ElementByteOrderMSB", false) ? std::endian::big : std::endian::little;
    if (is_true("CompressedData", false)) volume_.encoding = VolumeEncoding::packed;
    if (!is_true("BinaryData", true)) {
      if (volume_.encoding == VolumeEncoding::packed)
        header_.fail(*find("BinaryData"), "True, because the data are compressed");
      volume_.encoding = VolumeEncoding::text;
    }
    if (const HeaderField* const size = find("CompressedDataSize"))
      volume_.packed_size = static_cast<std::size_t>(header_.integer(*size, 0, kMostMeta));
    const HeaderField* const skip = find("HeaderSize");
    if (skip == nullptr) return;
    const std::int64_t bytes = header_.integer(*skip, -1, kMostMeta);
    if (bytes != 0 && volume_.encoding != VolumeEncoding::raw)
      header_.fail(*skip, "0, because the data are compressed or text");
    volume_.at_end = bytes < 0;
    volume_.skip = bytes < 0 ? 0 : static_cast<std::size_t>(bytes);
  }

  // The numbers of a field; empty if there is no such field.
  std::vector<double> numbers_of(const char* key, std::size_t count) const {
    const HeaderField* const field = find(key);
    if (field == nullptr) return {};
    std::vector<double> numbers = header_.numbers(*field, field->value);
    if (numbers.size() != count) header_.fail(*field, fmt::format("{} numbers", count));
    return numbers;
  }

  // Sets the affine map. Row k of the matrix is the direction of axis k. Coordinates point left,
  // back and up.
  void set_places(std::size_t axes) {
    const std::vector<double> spacings = numbers_of("ElementSpacing", axes),
                              matrix = numbers_of("TransformMatrix", axes * axes),
                              origin = numbers_of("Offset", axes);
    if (spacings.empty() && matrix.empty() && origin.empty()) return;
    std::vector<std::vector<double>> vectors(std::min<std::size_t>(axes, 3));
    for (std::size_t axis = 0; axis < vectors.size(); ++axis) {
      for (std::size_t k = 0; k < vectors.size(); ++k) {
        const double unit = axis == k ? 1 : 0;
        vectors[axis].push_back((matrix.empty() ? unit : matrix[axis * axes + k]) *
                                (spacings.empty() ? 1 : spacings[axis]));
      }
    }
    volume_.affine = affine_of(vectors, origin, {-1, -1, 1});
    if (!volume_.affine) note(options_, kNoPlaces);
  }

  VolumeHeader header_;
  const ReadOptions& options_;
  StoredVolume volume_;
};

}  // namespace

bool is_meta_image(const Input& input) {
  std::string_view first = input.text().substr(0, 4096);
  first = first.substr(0, first.find('\n'));
  const std::size_t end = first.find_first_of(" =");
  const std::string_view key = first.substr(0, end);
  return end != std::string_view::npos && first.find('=') != std::string_view::npos &&
         (key == "ObjectType" || key == "NDims");
}

Volume read_meta_image(const Input& input, const ReadOptions& options) {
  return MetaImage(input, options).read();
}

std::optional<std::string> meta_image_data_file(const Input& input) {
  return MetaImage(input, {}).data_file();
}

}  // namespace ph::detail
