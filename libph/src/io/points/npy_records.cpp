// SPDX-License-Identifier: MIT
// Reads structured arrays of NumPy, whose records have named fields, as points and as clouds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/points/npy_header.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

// One number of each record.
struct Column {
  std::string name;
  NpyType type;
  std::size_t offset = 0;
};

// A field with several numbers per record becomes several columns: xyz_0, xyz_1, xyz_2.
std::vector<Column> columns_of(const NpyHeader& header) {
  std::vector<Column> columns;
  for (const NpyField& field : header.fields) {
    for (std::size_t k = 0; field.type && k < field.count; ++k)
      columns.push_back({field.count == 1 ? field.name : fmt::format("{}_{}", field.name, k),
                         *field.type, field.offset + k * field.type->element.size});
  }
  return columns;
}

// The places of the columns x, y and z, in this order; empty if they are not all there once.
std::vector<std::size_t> coordinates_of(const std::vector<Column>& columns) {
  std::vector<std::size_t> places;
  for (const std::string_view name : {"x", "y", "z"}) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (lower_case(columns[k].name) == name) places.push_back(k);
  }
  const bool is_complete = places.size() == 3 && lower_case(columns[places[0]].name) == "x" &&
                           lower_case(columns[places[1]].name) == "y";
  if (!is_complete) places.clear();
  return places;
}

// The number of records, which must all be present.
std::size_t count_records(const Input& input, const NpyHeader& header) {
  const ArrayLayout layout{{header.record}, std::endian::little, false, header.offset};
  const std::size_t count = count_elements(input, layout, header.shape);
  if (header.fortran_order && header.shape.size() > 1) {
    input.fail({"a structured array in Fortran order",
                fmt::format("shape ({})", fmt::join(header.shape, ", ")), "C order",
                "save numpy.ascontiguousarray(a)"});
  }
  return count;
}

std::vector<std::size_t> chosen(const std::vector<Column>& columns, const NpyHeader& header,
                                const Input& input, const ReadOptions& options) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  if (!options.columns.empty())
    return chosen_columns(options.columns, names, columns.size(), input);
  std::vector<std::size_t> places = coordinates_of(columns);
  if (!places.empty()) {
    if (header.fields.size() > places.size())
      note(options, fmt::format("a structured array with the fields {}: {}, {} and {} are read as "
                                "coordinates; {} chooses others",
                                names_of_fields(header.fields), columns[places[0]].name,
                                columns[places[1]].name, columns[places[2]].name,
                                mark(Setting::columns, "NAMES")));
    return places;
  }
  const bool are_floats = std::ranges::all_of(header.fields, [](const NpyField& field) {
    return field.name.empty() || (field.type && field.type->kind == 'f');
  });
  if (!are_floats || columns.empty()) {
    input.fail({"a structured array", fmt::format("fields {}", names_of_fields(header.fields)),
                "fields x, y and z, or only floats",
                mark(Setting::columns, "NAMES") + " chooses the fields that are coordinates"});
  }
  note(options,
       Message::guess(fmt::format("a structured array: its fields {} are read as coordinates",
                                  names_of_fields(header.fields))));
  for (std::size_t k = 0; k < columns.size(); ++k) places.push_back(k);
  return places;
}

std::optional<FieldType> field_type(const NpyType& type) {
  const std::size_t log = type.element.size == 1   ? 0
                          : type.element.size == 2 ? 1
                          : type.element.size == 4 ? 2
                                                   : 3;
  constexpr std::array kUnsigned{FieldType::uint8, FieldType::uint16, FieldType::uint32,
                                 FieldType::uint64};
  constexpr std::array kSigned{FieldType::int8, FieldType::int16, FieldType::int32,
                               FieldType::int64};
  if (type.kind == 'i') return kSigned[log];
  if (type.kind != 'f') return kUnsigned[log];
  if (log < 2) return std::nullopt;
  return log == 2 ? FieldType::float32 : FieldType::float64;
}

}  // namespace

bool is_npy_of_records(const Input& input) { return !read_npy_header(input).fields.empty(); }

Points points_of_records(const Input& input, const ReadOptions& options) {
  const NpyHeader header = read_npy_header(input);
  const std::size_t count = count_records(input, header);
  const std::vector<Column> columns = columns_of(header);
  const std::vector<std::size_t> places = chosen(columns, header, input, options);
  input.require_memory(count * places.size() * sizeof(double));
  Points points(static_cast<Index>(count), static_cast<Index>(places.size()));
  double* number = points.data();
  for (std::size_t i = 0; i < count; ++i) {
    constexpr std::size_t poll_mask = 0xFFFF;
    if ((i & poll_mask) == 0) input.poll();
    for (const std::size_t place : places) {
      const auto& [name, type, offset] = columns[place];
      const std::size_t at = header.offset + i * header.record + offset;
      bool is_exact = true;
      *number++ = type.element.load(input.bytes().data() + at, type.order, is_exact);
      if (!is_exact)
        input.fail_at_byte(at, {"integer that a double cannot hold",
                                fmt::format("one near {:.0f}", number[-1]),
                                "at most 2^53",
                                {}});
    }
  }
  // As in other clouds, a record without a place is a hole.
  const bool has_holes = !coordinates_of(columns).empty();
  return without_nan_rows(std::move(points), input, options, has_holes);
}

Cloud cloud_of_records(const Input& input, const ReadOptions& options) {
  const NpyHeader header = read_npy_header(input);
  const std::size_t count = count_records(input, header);
  if (header.shape.empty() || header.shape.size() > 2) {
    input.fail({"not an array of points",
                fmt::format("shape ({})", fmt::join(header.shape, ", ")),
                "(points) or (rows, columns) for a structured array",
                {}});
  }
  Cloud cloud;
  std::vector<const NpyField*> kept;
  std::vector<std::string> left_out;
  for (const NpyField& field : header.fields) {
    const auto type = field.type ? field_type(*field.type) : std::nullopt;
    if (!type || field.count == 0 || field.name.empty()) {
      if (!field.name.empty()) left_out.push_back(printable(field.name, 40));
      continue;
    }
    kept.push_back(&field);
    cloud.fields.push_back({field.name, *type, field.count, cloud.stride});
    cloud.stride += field.count * size_of(*type);
  }
  if (!left_out.empty())
    note(options, fmt::format("left out, because they are not numbers of a cloud: {}",
                              fmt::join(left_out, ", ")));
  name_coordinates(cloud);
  const bool are_three = cloud.fields.size() == 3 && cloud.find("x") == nullptr &&
                         std::ranges::all_of(cloud.fields, [](const CloudField& field) {
                           return field.count == 1 && (field.type == FieldType::float32 ||
                                                       field.type == FieldType::float64);
                         });
  for (std::size_t k = 0; are_three && k < 3; ++k) cloud.fields[k].name = std::string(1, "xyz"[k]);
  cloud.width = header.shape.back();
  cloud.height = header.shape.size() == 2 ? header.shape.front() : 1;
  if (count == 0) {
    cloud.width = 0;
    cloud.height = 1;
    if (!options.allow_empty)
      input.fail({"no points",
                  {},
                  "at least one",
                  mark(Setting::allow_empty) + " accepts an empty cloud"});
  }
  input.require_memory(count * cloud.stride);
  cloud.data.resize(count * cloud.stride);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t width = kept[k]->type->element.size;
    for (std::size_t i = 0; i < count; ++i) {
      const std::byte* from =
          input.bytes().data() + header.offset + i * header.record + kept[k]->offset;
      std::byte* const to = cloud.data.data() + i * cloud.stride + cloud.fields[k].offset;
      for (std::size_t n = 0; n < kept[k]->count; ++n) {
        std::memcpy(to + n * width, from + n * width, width);
        if (kept[k]->type->order != std::endian::native)
          std::reverse(to + n * width, to + (n + 1) * width);
      }
    }
  }
  for (const std::string_view name : {"x", "y", "z"}) {
    const CloudField* const field = cloud.find(name);
    if (field == nullptr || field->count != 1) {
      input.fail({"a structured array",
                  fmt::format("fields {}", names_of_fields(header.fields)),
                  "fields x, y and z, or three fields of floats",
                  {}});
    }
  }
  return cloud;
}

}  // namespace ph::detail
