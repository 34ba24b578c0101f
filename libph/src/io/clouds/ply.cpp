// SPDX-License-Identifier: MIT
#include "libph/src/io/clouds/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "libph/src/io/bytes/field_access.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace detail {
namespace {

constexpr std::int64_t kMostInteger = std::numeric_limits<std::int64_t>::max();

// The least number of bytes that a row of an element takes. It is used to check the stated number
// of rows before anything is allocated.
std::size_t least_bytes(const PlyElement& element, bool ascii) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += ascii ? 2 : size_of(property.length_type.value_or(property.type));
  }
  return bytes;
}

}  // namespace

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
                         fmt::format("at most {} for the {} bytes that follow", rest / least, rest),
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
                    {"line too short", "the end of the line", "a number for each property", {}});
      }
      if constexpr (std::is_floating_point_v<T>) {
        value = cells_.floating<T>(Allow::any);
      } else {  // PLY has no 64-bit integers
        value = static_cast<T>(cells_.integer(
            static_cast<std::int64_t>(std::numeric_limits<T>::min()),
            sizeof(T) == 8 ? kMostInteger
                           : static_cast<std::int64_t>(std::numeric_limits<T>::max()),
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
                      fmt::format("0 to {} for the bytes that follow", rest),
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
  if (!bytes) input.fail({"too many vertices", fmt::format("{}", element.count), "fewer", {}});
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
          detail::require_growth(input, mesh.corners);
          mesh.corners.push_back(static_cast<Index>(vertex));
        }
      }
    }
    body.end_row();
    detail::require_growth(input, mesh.offsets);
    mesh.offsets.push_back(mesh.corners.size());
  }
}

// Reads all elements in the order of the file. Faces are skipped if `mesh` is null.
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
  detail::name_coordinates(cloud);
  if (vertex->count == 0 && !options.allow_empty) {
    input.fail({"no vertices",
                {},
                "at least one",
                mark(Setting::allow_empty) + " accepts an empty cloud"});
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
  return read_ply_mesh(
      Input::open(path, options.context, Input::Excess::refused, detail::start_check(Format::ply)),
      options);
}

}  // namespace ph
