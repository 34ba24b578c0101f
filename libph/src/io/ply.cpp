// SPDX-License-Identifier: MIT
#include "ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "field_access.hpp"
#include "ph/io/cloud_io.hpp"

namespace ph {
namespace detail {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

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

// Walks over the lines of a header.
class HeaderParser {
 public:
  explicit HeaderParser(const Input& input) : input_(input), lines_(input, 0, 0), cells_(lines_) {}

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
    if (!cells_.more()) fail_line("PLY header: line too short", "another word");
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
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) fail_line("PLY element named twice", "different names");
    }
    if (!cells_.more()) fail_line("PLY header: line too short", "a count");
    element.count = static_cast<std::size_t>(cells_.integer(0, kMost, "count"));
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
    auto& properties = header_.elements.back().properties;
    for (const PlyProperty& other : properties) {
      if (other.name == property.name) fail_line("PLY property named twice", "different names");
    }
    properties.push_back(std::move(property));
  }

  const Input& input_;
  TextLines lines_;
  Cells cells_;
  PlyHeader header_;
};

// Bytes that an element takes at least, by which its count is checked before anything is allocated.
std::size_t least_bytes(const PlyElement& element, bool ascii) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += ascii ? 2 : size_of(property.length_type.value_or(property.type));
  }
  return bytes;
}

}  // namespace

bool is_ply(const Input& input) {
  return input.text().starts_with("ply\n") || input.text().starts_with("ply\r");
}

PlyHeader read_ply_header(const Input& input) { return HeaderParser(input).parse(); }

PlyBody::PlyBody(const Input& input, const PlyHeader& header)
    : input_(input),
      header_(header),
      lines_(input, header.offset, header.lines),
      cells_(lines_),
      cursor_(input, header.order, header.offset) {}

void PlyBody::start_element(const PlyElement& element) {
  element_ = &element;
  const std::size_t rest =
      header_.ascii ? input_.size() - lines_.offset() + 1 : cursor_.remaining();
  const std::size_t least = least_bytes(element, header_.ascii);
  if (element.count > 0 && element.count > rest / least) {
    input_.fail_at_byte(header_.ascii ? lines_.offset() : cursor_.offset(),
                        {fmt::format("truncated: the count of {} does not fit the file",
                                     printable(element.name, 40)),
                         fmt::format("{}", element.count),
                         fmt::format("at most {}, by the {} bytes that follow", rest / least, rest),
                         {}});
  }
}

void PlyBody::start_row(std::size_t row) {
  if (!header_.ascii) return;
  if (!lines_.next()) {
    input_.fail(
        {fmt::format("truncated: {} of {} {}", row, element_->count, printable(element_->name, 40)),
         {},
         {},
         {}});
  }
  cells_.start();
}

void PlyBody::end_row() {
  if (header_.ascii) cells_.expect_end("the end of the line");
}

void PlyBody::scalar(FieldType type, std::byte* to) {
  visit_type(type, [&]<class T>(T) {
    T value{};
    if (!header_.ascii) {
      value = cursor_.read<T>("data");
    } else {
      if (!cells_.more()) {
        lines_.fail(lines_.line().data() + lines_.line().size(),
                    {"line too short", "its end", "a number for each property", {}});
      }
      if constexpr (std::is_floating_point_v<T>) {
        value = cells_.floating<T>(Allow::any);
      } else {  // PLY has no 64-bit integers
        value = static_cast<T>(cells_.integer(
            static_cast<std::int64_t>(std::numeric_limits<T>::min()),
            sizeof(T) == 8 ? kMost : static_cast<std::int64_t>(std::numeric_limits<T>::max()),
            "value"));
      }
    }
    std::memcpy(to, &value, sizeof(T));
  });
}

double PlyBody::number(FieldType type) {
  std::array<std::byte, 8> raw{};
  scalar(type, raw.data());
  return visit_type(type, [&]<class T>(T) {
    return static_cast<double>(load<T>(raw.data(), std::endian::native));
  });
}

std::size_t PlyBody::list_length(const PlyProperty& property) {
  const std::size_t at = header_.ascii ? 0 : cursor_.offset();
  const char* place = header_.ascii ? cells_.place() : nullptr;
  const double length = number(*property.length_type);
  const std::size_t rest =
      header_.ascii ? lines_.line().size() / 2 + 1 : cursor_.remaining() / size_of(property.type);
  if (length < 0 || length > static_cast<double>(rest)) {
    const Fault fault{fmt::format("length of list {}", printable(property.name, 40)),
                      fmt::format("{:.0f}", length),
                      fmt::format("0 to {}, by the bytes that follow", rest),
                      {}};
    if (header_.ascii) lines_.fail(place, fault);
    input_.fail_at_byte(at, fault);
  }
  return static_cast<std::size_t>(length);
}

void PlyBody::skip_list(const PlyProperty& property) {
  const std::size_t length = list_length(property);
  if (!header_.ascii) {
    cursor_.take(length * size_of(property.type), "list");
    return;
  }
  for (std::size_t k = 0; k < length; ++k) number(property.type);
}

void PlyBody::skip_element() {
  for (std::size_t row = 0; row < element_->count; ++row) {
    if ((row & 0xFFF) == 0) input_.poll();
    start_row(row);
    for (const PlyProperty& property : element_->properties) {
      if (property.length_type) {
        skip_list(property);
      } else {
        number(property.type);
      }
    }
    end_row();
  }
}

std::span<const std::byte> PlyBody::raw_rows(std::size_t bytes) {
  return cursor_.take(bytes, "data");
}

void PlyBody::expect_end() {
  if (!header_.ascii) {
    cursor_.expect_end();
  } else if (lines_.next()) {
    lines_.fail(lines_.line().data(), {"trailing data", "another line", "the end of the file", {}});
  }
}

}  // namespace detail

namespace {

using detail::PlyBody;
using detail::PlyElement;
using detail::PlyHeader;
using detail::PlyProperty;

Cloud read_vertices(const Input& input, const PlyHeader& header, const PlyElement& element,
                    PlyBody& body) {
  Cloud cloud;
  cloud.width = static_cast<Index>(element.count);
  bool lists = false;
  for (const PlyProperty& property : element.properties) {
    if (property.length_type) {
      lists = true;
      continue;
    }
    cloud.fields.push_back({property.name, property.type, 1, cloud.stride});
    cloud.stride += size_of(property.type);
  }
  const auto bytes = checked_product(element.count, cloud.stride);
  if (!bytes) input.fail({"too many vertices", fmt::format("{}", element.count), "less", {}});
  input.require_memory(*bytes);
  if (!header.ascii && !lists && header.order == std::endian::native) {
    const auto raw = body.raw_rows(*bytes);
    cloud.data.assign(raw.begin(), raw.end());
    return cloud;
  }
  cloud.data.resize(*bytes);
  std::byte* record = cloud.data.data();
  for (std::size_t row = 0; row < element.count; ++row, record += cloud.stride) {
    if ((row & 0xFFF) == 0) input.poll();
    body.start_row(row);
    std::byte* to = record;
    for (const PlyProperty& property : element.properties) {
      if (property.length_type) {
        body.skip_list(property);
      } else {
        body.scalar(property.type, to);
        to += size_of(property.type);
      }
    }
    body.end_row();
  }
  return cloud;
}

bool is_corner_list(const PlyProperty& property) {
  return property.length_type && property.type < FieldType::float32 &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_faces(const Input& input, const PlyElement& element, Index vertices, PlyBody& body,
                Mesh& mesh) {
  for (std::size_t row = 0; row < element.count; ++row) {
    if ((row & 0xFFF) == 0) input.poll();
    body.start_row(row);
    for (const PlyProperty& property : element.properties) {
      if (!property.length_type) {
        body.number(property.type);
      } else if (!is_corner_list(property)) {
        body.skip_list(property);
      } else {
        const std::size_t corners = body.list_length(property);
        if (corners == 0) input.fail({fmt::format("face {} without corners", row), {}, {}, {}});
        for (std::size_t k = 0; k < corners; ++k) {
          const double vertex = body.number(property.type);
          if (!(vertex >= 0 && vertex < static_cast<double>(vertices))) {
            input.fail({fmt::format("vertex of face {} out of range", row),
                        fmt::format("{:.0f}", vertex),
                        fmt::format("0 to {}", vertices - 1),
                        {}});
          }
          mesh.corners.push_back(static_cast<Index>(vertex));
        }
      }
    }
    body.end_row();
    mesh.offsets.push_back(mesh.corners.size());
  }
}

// Reads all elements in the order of the file; the faces only if a mesh is wanted.
Cloud read_elements(const Input& input, const ReadOptions& options, Mesh* mesh) {
  const PlyHeader header = detail::read_ply_header(input);
  PlyBody body(input, header);
  Cloud cloud;
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end()) {
    input.fail({"PLY header", "no element vertex", "one", {}});
  }
  for (const PlyElement& element : header.elements) {
    body.start_element(element);
    const bool faces =
        element.name == "face" &&
        std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) == 1;
    if (element.name == "vertex") {
      cloud = read_vertices(input, header, element, body);
    } else if (mesh != nullptr && faces) {
      read_faces(input, element, static_cast<Index>(vertex->count), body, *mesh);
    } else {
      body.skip_element();
    }
  }
  body.expect_end();
  if (vertex->count == 0 && !options.allow_empty) {
    input.fail({"no vertices", {}, "at least one", "--allow-empty accepts an empty cloud"});
  }
  return cloud;
}

}  // namespace

Cloud read_ply(const Input& input, const ReadOptions& options) {
  return read_elements(input, options, nullptr);
}

Mesh read_ply_mesh(const Input& input, const ReadOptions& options) {
  Mesh mesh;
  const Cloud cloud = read_elements(input, options, &mesh);
  for (const char* name : {"x", "y", "z"}) {
    if (cloud.find(name) == nullptr) {
      input.fail({fmt::format("no vertex property {}", name), {}, "x, y and z", {}});
    }
  }
  mesh.vertices = points_of(cloud);
  return mesh;
}

Mesh read_ply_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  return read_ply_mesh(Input::open(path, options.context), options);
}

}  // namespace ph
