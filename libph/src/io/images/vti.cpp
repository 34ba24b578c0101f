// SPDX-License-Identifier: MIT
// Reads VTI, the images of VTK: an XML text whose numbers are text, Base64 or raw bytes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "libph/src/io/images/markup.hpp"
#include "libph/src/io/images/vti_data.hpp"

namespace ph::detail {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::int64_t kMostBytes = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostVti = (std::int64_t{1} << 31) - 1;  // VTK's indices have 32 bits

struct VtiType {
  std::string_view name, kind;  // the kind is a name as for element_type
};
constexpr std::array kVtiTypes{VtiType{"Int8", "i1"},    VtiType{"UInt8", "u1"},
                               VtiType{"Int16", "i2"},   VtiType{"UInt16", "u2"},
                               VtiType{"Int32", "i4"},   VtiType{"UInt32", "u4"},
                               VtiType{"Int64", "i8"},   VtiType{"UInt64", "u8"},
                               VtiType{"Float32", "f4"}, VtiType{"Float64", "f8"}};

bool is_blank(std::string_view text) {
  return text.find_first_not_of(kXmlSpace) == std::string_view::npos;
}

// An array of numbers, with one or several per point or per cell.
struct VtiArray {
  XmlTag tag;
  bool is_of_cells = false;
  std::string_view content = {};  // the text of the element

  std::string_view name() const {
    const HeaderField* const field = tag.find("Name");
    return field == nullptr ? std::string_view() : field->value;
  }
};

class Vti {
 public:
  Vti(const Input& input, const ReadOptions& options)
      : input_(input), markup_(input), fields_(input), options_(options) {}

  Volume read() {
    read_root();
    read_elements();
    const VtiArray& array = chosen();
    if (const HeaderField* const count = array.tag.find("NumberOfComponents");
        count && fields_.integer(*count, 0, kMostVti) != 1)
      fields_.fail(*count, "1, because an image has one number per voxel",
                   "save one component, or save the array as .npy and take one, a[..., 0]");
    const HeaderField& type = markup_.need(array.tag, "type");
    const auto* const known = std::ranges::find(kVtiTypes, type.value, &VtiType::name);
    if (known == kVtiTypes.end())
      fields_.fail(type, "Int8 to Int64, UInt8 to UInt64, Float32 or Float64");
    StoredVolume volume;
    volume.kind = known->kind;
    set_places(array.is_of_cells, volume);
    drop_last_axes(volume.extents);
    return {without_nan_pixels(load(array, volume), input_, options_), volume.affine};
  }

 private:
  void read_root() {
    std::string_view start = input_.text();
    if (start.starts_with(kByteOrderMark)) start.remove_prefix(kByteOrderMark.size());
    const bool is_xml = start.starts_with('<');
    if (is_xml) root_ = markup_.next();
    if (!is_xml || root_.name != "VTKFile" || !root_.opens || root_.closes) {
      input_.fail_at_byte(0, {"not a VTI file",
                              '"' + printable(start.substr(0, 20)) + '"',
                              "<VTKFile type=\"ImageData\" …>",
                              {}});
    }
    if (const HeaderField& type = markup_.need(root_, "type"); type.value != "ImageData")
      fields_.fail(type, "ImageData", "other data sets of VTK have no grid of voxels");
  }

  // Reads the elements up to the appended data or, without appended data, up to the end.
  void read_elements() {
    do {
      std::vector<std::string_view> path = markup_.open();
      const XmlTag& tag = markup_.next();
      take_text(path);
      if (!tag.opens) continue;
      path.push_back(tag.name);
      if (path.size() == 2 && tag.name == "AppendedData") {
        find_appended(tag);
        return;
      }
      take_element(path, tag);
    } while (!markup_.open().empty());
    expect_end(markup_.offset());
  }

  // True for the path of an element in the only piece of the image.
  static bool is_in_piece(const std::vector<std::string_view>& path) {
    return path.size() > 3 && path[1] == "ImageData" && path[2] == "Piece" &&
           (path[3] == "PointData" || path[3] == "CellData");
  }
  static bool is_array(const std::vector<std::string_view>& path) {
    return path.size() == 5 && is_in_piece(path) && path[4] == "DataArray";
  }

  // The text of an array is its numbers. Arrays in other places, such as FieldData, and elements
  // in arrays describe the data.
  void take_text(const std::vector<std::string_view>& path) {
    if (is_blank(markup_.text())) return;
    const bool is_in_array = is_array(path);
    if (is_in_array && arrays_.back().content.empty()) {
      arrays_.back().content = markup_.text();
    } else if (is_in_array || std::ranges::count(path, "DataArray") == 0) {
      input_.fail_at_byte(
          static_cast<std::size_t>(markup_.text().data() - input_.text().data()),
          {"text outside an array", '"' + printable(markup_.text(), 40) + '"', "a tag", {}});
    }
  }

  void take_element(const std::vector<std::string_view>& path, const XmlTag& tag) {
    const bool is_of_cells = path.size() > 3 && path[3] == "CellData";
    if (is_array(path)) {
      arrays_.push_back({tag, is_of_cells});
    } else if (path.size() == 4 && is_in_piece(path)) {
      keep(sections_[is_of_cells ? 1 : 0], tag, "one");
    } else if (path.size() == 3 && tag.name == "Piece") {
      keep(piece_, tag,
           "one; join the pieces, for example with vtkXMLImageDataWriter, or save the array as "
           ".npy");
    } else if (path.size() == 2 && tag.name == "ImageData") {
      keep(image_, tag, "one");
    }
    if (tag.name != "DataArray") return;
    if (const HeaderField* const offset = tag.find("offset"))
      last_offset_ = std::max(last_offset_, fields_.integer(*offset, 0, kMostBytes));
  }

  void keep(std::optional<XmlTag>& place, const XmlTag& tag, std::string_view expected) {
    if (place) markup_.fail(tag, fmt::format("a second {}", tag.name), expected);
    place = tag;
  }

  // The appended data begin after "_", and end before the last tags of the file.
  void find_appended(const XmlTag& tag) {
    appended_ = tag;
    const std::string_view text = input_.text();
    constexpr std::string_view kClose = "</AppendedData>", kCloseRoot = "</VTKFile>";
    data_end_ = text.rfind(kClose);
    const std::size_t root = text.rfind(kCloseRoot);
    if (root == std::string_view::npos || data_end_ == std::string_view::npos ||
        data_end_ < tag.end || root < data_end_ + kClose.size() ||
        !is_blank(text.substr(data_end_ + kClose.size(), root - data_end_ - kClose.size()))) {
      input_.fail_at_byte(input_.size(), {"truncated in the appended data",
                                          "the end of the file",
                                          "</AppendedData> and </VTKFile>",
                                          {}});
    }
    expect_end(root + kCloseRoot.size());
    data_begin_ = std::min(text.find_first_not_of(kXmlSpace, tag.end), data_end_);
    if (text[data_begin_] != '_')
      input_.fail_at_byte(data_begin_,
                          {"appended data", printable(text.substr(data_begin_, 1)), "\"_\"", {}});
    ++data_begin_;
  }

  void expect_end(std::size_t offset) const {
    if (!is_blank(input_.text().substr(offset)))
      input_.fail_at_byte(offset, {"trailing data",
                                   fmt::format("{} more bytes", input_.size() - offset),
                                   "the end of the file after </VTKFile>",
                                   {}});
  }

  const XmlTag& need(const std::optional<XmlTag>& tag, std::string_view name) const {
    if (!tag) markup_.fail(root_, fmt::format("no element {}", name), "one");
    return *tag;
  }

  // The array that the caller names, the only array, or the array that the file marks as the
  // scalars of the points or of the cells.
  const VtiArray& chosen() const {
    std::vector<std::string> names;
    std::vector<const VtiArray*> named, scalars;
    for (const VtiArray& array : arrays_) {
      names.push_back(printable(array.name(), 40));
      const HeaderField* const marked = sections_[array.is_of_cells ? 1 : 0]->find("Scalars");
      if (array.name() == input_.member()) named.push_back(&array);
      if (marked != nullptr && marked->value == array.name()) scalars.push_back(&array);
    }
    if (!input_.member().empty()) {
      if (named.size() > 1)
        markup_.fail(named[1]->tag, "a second array " + names[0], "one array of this name");
      if (named.size() == 1) return *named[0];
    } else if (arrays_.size() == 1) {
      return arrays_[0];
    } else if (scalars.size() == 1) {
      note(options_, fmt::format("read the array {}, which the file marks as its scalars",
                                 printable(scalars[0]->name(), 40)));
      return *scalars[0];
    }
    refuse_members(input_, names, "the image");
  }

  // Sets the extents and the affine map to space.
  void set_places(bool is_of_cells, StoredVolume& volume) {
    const XmlTag& image = need(image_, "ImageData");
    const HeaderField& whole = markup_.need(image, "WholeExtent");
    const std::vector<std::int64_t> ends = fields_.integers(whole, -kMostVti, kMostVti);
    if (ends.size() != 6 || ends[0] > ends[1] || ends[2] > ends[3] || ends[4] > ends[5])
      fields_.fail(whole, "the first and the last index of three axes");
    const HeaderField& part = markup_.need(need(piece_, "Piece"), "Extent");
    if (fields_.integers(part, -kMostVti, kMostVti) != ends)
      fields_.fail(part, fmt::format("{}, the extent of the image", fmt::join(ends, " ")));
    std::array<double, 3> first{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t steps = ends[2 * axis + 1] - ends[2 * axis];
      const bool has_cells = is_of_cells && steps > 0;
      volume.extents.push_back(has_cells ? steps : steps + 1);
      first[axis] = static_cast<double>(ends[2 * axis]) + (has_cells ? 0.5 : 0.0);
    }
    const std::vector<double> spacings = numbers_of(image, "Spacing", 3),
                              directions = numbers_of(image, "Direction", 9);
    std::vector<double> origin = numbers_of(image, "Origin", 3);
    if (spacings.empty() && directions.empty() && origin.empty()) return;
    origin.resize(3);
    std::vector<std::vector<double>> vectors(3, std::vector<double>(3));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t r = 0; r < 3; ++r) {
        const double unit = r == axis ? 1 : 0;
        vectors[axis][r] = (directions.empty() ? unit : directions[3 * r + axis]) *
                           (spacings.empty() ? 1 : spacings[axis]);
        origin[r] += vectors[axis][r] * first[axis];
      }
    }
    volume.affine = affine_of(vectors, origin, {1, 1, 1});
    if (!volume.affine) note(options_, kNoPlaces);
  }

  std::vector<double> numbers_of(const XmlTag& tag, std::string_view name,
                                 std::size_t count) const {
    const HeaderField* const field = tag.find(name);
    if (field == nullptr) return {};
    std::vector<double> numbers = fields_.numbers(*field, field->value);
    if (numbers.size() != count) fields_.fail(*field, fmt::format("{} numbers", count));
    return numbers;
  }

  Image load(const VtiArray& array, StoredVolume& volume) const {
    const HeaderField& format = markup_.need(array.tag, "format");
    const std::string_view text = input_.text();
    const std::size_t begin = array.content.empty()
                                  ? array.tag.end
                                  : static_cast<std::size_t>(array.content.data() - text.data());
    const std::size_t end = begin + array.content.size();
    if (format.value == "ascii") {
      volume.encoding = VolumeEncoding::text;
      volume.offset = begin;
      return load_numbers(Input::view(text.substr(0, end), input_.name(), input_.context()),
                          volume);
    }
    VtiBytes bytes{begin, end};
    if (format.value == "appended") {
      set_appended(array, bytes);
    } else if (format.value != "binary") {
      fields_.fail(format, "ascii, binary or appended");
    }
    const HeaderField& order = markup_.need(root_, "byte_order");
    if (order.value != "LittleEndian" && order.value != "BigEndian")
      fields_.fail(order, "LittleEndian or BigEndian");
    volume.order = order.value == "BigEndian" ? std::endian::big : std::endian::little;
    if (const HeaderField* const type = root_.find("header_type")) {
      if (type->value != "UInt32" && type->value != "UInt64")
        fields_.fail(*type, "UInt32 or UInt64");
      bytes.count_size = type->value == "UInt64" ? 8 : 4;
    }
    if (const HeaderField* const compressor = root_.find("compressor")) {
      if (compressor->value != "vtkZLibDataCompressor")
        fields_.fail(*compressor, "vtkZLibDataCompressor, or no compressor",
                     "save it again with SetCompressorTypeToZLib()");
      bytes.is_packed = true;
    }
    return load_vti(input_, bytes, volume);
  }

  void set_appended(const VtiArray& array, VtiBytes& bytes) const {
    const HeaderField& offset = markup_.need(array.tag, "offset");
    const XmlTag& appended = need(appended_, "AppendedData");
    const HeaderField& encoding = markup_.need(appended, "encoding");
    if (encoding.value != "raw" && encoding.value != "base64")
      fields_.fail(encoding, "raw or base64");
    const auto most = static_cast<std::int64_t>(data_end_ - data_begin_);
    const std::int64_t at = fields_.integer(offset, 0, most);
    bytes.begin = data_begin_ + static_cast<std::size_t>(at);
    bytes.end = data_end_;
    bytes.is_base64 = encoding.value == "base64";
    bytes.is_last = at == last_offset_;
  }

  const Input& input_;
  Markup markup_;
  VolumeHeader fields_;  // reads and refuses values
  const ReadOptions& options_;
  XmlTag root_;
  std::optional<XmlTag> image_, piece_, appended_;
  std::array<std::optional<XmlTag>, 2> sections_;  // the data of points and of cells
  std::vector<VtiArray> arrays_;
  std::int64_t last_offset_ = 0;
  std::size_t data_begin_ = 0, data_end_ = 0;  // the appended data
};

}  // namespace

bool is_vti(const Input& input) {
  std::string_view text = input.text().substr(0, 4096);
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (!text.starts_with("<?xml") && !text.starts_with("<VTKFile")) return false;
  const std::size_t root = text.find("<VTKFile");
  if (root == std::string_view::npos) return false;
  text = text.substr(root, text.find('>', root) - root);
  return text.find("type=\"ImageData\"") != std::string_view::npos ||
         text.find("type='ImageData'") != std::string_view::npos;
}

Volume read_vti(const Input& input, const ReadOptions& options) {
  return Vti(input, options).read();
}

}  // namespace ph::detail
