// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "libph/src/io/clouds/ply.hpp"

namespace ph::detail {
namespace {

constexpr std::int64_t kMostElements = std::numeric_limits<std::int64_t>::max();

std::optional<FieldType> ply_type(std::string_view name) {
  if (name == "char" || name == "int8") return FieldType::int8;
  if (name == "uchar" || name == "uint8") return FieldType::uint8;
  if (name == "short" || name == "int16") return FieldType::int16;
  if (name == "ushort" || name == "uint16") return FieldType::uint16;
  if (name == "int" || name == "int32") return FieldType::int32;
  if (name == "uint" || name == "uint32") return FieldType::uint32;
  if (name == "float" || name == "float32") return FieldType::float32;
  if (name == "double" || name == "float64") return FieldType::float64;
  return std::nullopt;
}

// Reads the lines of a header.
class PlyHeaderParser {
 public:
  explicit PlyHeaderParser(const Input& input)
      : input_(input), lines_(input, 0, 0), cells_(lines_) {}

  PlyHeader parse() {
    next_line();
    if (cells_.word() != "ply") fail_line("not a PLY file", "ply");
    bool format = false;
    while (true) {
      next_line();
      const std::string_view key = cells_.word();
      if (key == "end_header") break;
      if (key == "comment" || key == "obj_info") continue;
      if (key == "format" && !format) {
        parse_format();
        format = true;
      } else if (key == "element") {
        parse_element();
      } else if (key == "property" && !header_.elements.empty()) {
        parse_property();
      } else {
        fail_line("PLY header", "format (once), element, property, comment or end_header");
      }
      if (cells_.more()) fail_line("PLY header: extra words", "the end of the line");
    }
    if (!format) input_.fail({"PLY header", "no format", "one", {}});
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty() && element.count > 0) {
        input_.fail({fmt::format("element {} without properties", printable(element.name, 40)),
                     {},
                     {},
                     {}});
      }
    }
    header_.offset = lines_.offset();
    header_.lines = lines_.number();
    return std::move(header_);
  }

 private:
  void next_line() {
    if (!lines_.next()) {
      input_.fail({"truncated PLY header", "the end of the file", "end_header", {}});
    }
    cells_ = Cells(lines_);
    cells_.start();
  }
  [[noreturn]] void fail_line(std::string what, std::string expected) {
    lines_.fail(lines_.line().data(), {std::move(what),
                                       fmt::format("\"{}\"", printable(lines_.line(), 60)),
                                       std::move(expected),
                                       {}});
  }
  std::string word() {
    if (!cells_.more()) fail_line("PLY header: line too short", "one more word");
    return std::string(cells_.word());
  }
  FieldType type() {
    const std::string name = word();
    const auto type = ply_type(name);
    if (!type)
      fail_line("unknown PLY type", "char, uchar, short, ushort, int, uint, float or double");
    return *type;
  }
  void parse_format() {
    const std::string name = word();
    if (name == "ascii") {
      header_.ascii = true;
    } else if (name == "binary_little_endian" || name == "binary_big_endian") {
      header_.order = name == "binary_big_endian" ? std::endian::big : std::endian::little;
    } else {
      fail_line("PLY format", "ascii, binary_little_endian or binary_big_endian");
    }
    if (word() != "1.0") fail_line("PLY version", "1.0");
  }
  void parse_element() {
    PlyElement element;
    element.name = word();
    if (!elements_.insert(element.name).second) {
      fail_line("PLY element named twice", "different names");
    }
    properties_.clear();
    if (!cells_.more()) fail_line("PLY header: line too short", "a count");
    element.count = static_cast<std::size_t>(cells_.integer(0, kMostElements, "count"));
    header_.elements.push_back(std::move(element));
  }
  void parse_property() {
    PlyProperty property;
    std::string first = word();
    if (first == "list") {
      property.length_type = type();
      if (*property.length_type >= FieldType::float32)
        fail_line("type of a list length", "an integer type");
      property.type = type();
    } else {
      const auto known = ply_type(first);
      if (!known)
        fail_line("unknown PLY type", "char, uchar, short, ushort, int, uint, float or double");
      property.type = *known;
    }
    property.name = word();
    if (!properties_.insert(property.name).second) {
      fail_line("PLY property named twice", "different names");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  const Input& input_;
  TextLines lines_;
  Cells cells_;
  PlyHeader header_;
  // The names of the elements so far, and of the properties of the last element.
  std::set<std::string> elements_, properties_;
};

}  // namespace

bool is_ply(const Input& input) {
  return input.text().starts_with("ply\n") || input.text().starts_with("ply\r");
}

PlyHeader read_ply_header(const Input& input) { return PlyHeaderParser(input).parse(); }

}  // namespace ph::detail
