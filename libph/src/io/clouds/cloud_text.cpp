// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/clouds/cloud_rows.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

std::string lower_unquoted(std::string_view word) {
  std::string result = lower_case(word);
  std::erase(result, '"');
  return result;
}

constexpr std::array<std::string_view, 3> kCoordinates{"x", "y", "z"};

bool is_share(double value) { return value >= 0 && value <= 1; }
bool is_byte(double value) { return value >= 0 && value <= 255 && value == std::floor(value); }

template <class Is>
bool all_in_column(PointsView rows, std::size_t column, const Is& is) {
  for (Index i = 0; i < rows.rows(); ++i)
    if (!is(rows(i, static_cast<Index>(column)))) return false;
  return true;
}

std::vector<std::string> column_names(PointsView rows, const std::vector<std::string>& header,
                                      const Input& input, detail::RowSource source) {
  const auto columns = static_cast<std::size_t>(rows.cols());
  std::vector<std::string> names;
  if (header.size() == columns) {
    for (const std::string& word : header) names.push_back(lower_unquoted(word));
    const bool has_xyz = std::all_of(
        kCoordinates.begin(), kCoordinates.end(),
        [&](std::string_view name) { return std::count(names.begin(), names.end(), name) == 1; });
    if (!has_xyz) {
      input.fail({"header", fmt::format("{} names", names.size()), "x, y and z among them", {}});
    }
    std::vector<std::string_view> sorted(names.begin(), names.end());
    std::erase(sorted, "");  // columns without a name may occur more than once
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      input.fail({"column named twice", printable(*twice, 40), "different names", {}});
    }
    return names;
  }
  if (columns < 3) {
    input.fail({"too few columns", fmt::format("{}", columns), "at least x y z", {}});
  }
  names = {"x", "y", "z"};
  // PTS has an intensity before the colours, or only an intensity.
  const bool intensity = source == detail::RowSource::pts && (columns == 4 || columns == 7);
  if (intensity) names.emplace_back("intensity");
  const std::size_t first = names.size();
  const auto are = [&](auto* kind) {
    return columns >= first + 3 && all_in_column(rows, first, kind) &&
           all_in_column(rows, first + 1, kind) && all_in_column(rows, first + 2, kind);
  };
  const bool colours = are(&is_byte) || (source == detail::RowSource::array && are(&is_share));
  for (std::size_t k = first; k < columns; ++k) {
    constexpr std::array<std::string_view, 3> kColours{"red", "green", "blue"};
    names.push_back(colours && k < first + 3 ? std::string(kColours[k - first])
                                             : fmt::format("field_{}", k));
  }
  return names;
}

}  // namespace

namespace detail {

Cloud cloud_of_rows(const TextTable& table, const Input& input, const ReadOptions& options,
                    RowSource source) {
  Cloud cloud;
  cloud.width = table.rows.rows();
  if (cloud.width == 0) {
    if (!options.allow_empty) {
      input.fail({"no points",
                  {},
                  "one point per line",
                  mark(Setting::allow_empty) + " accepts an empty cloud"});
    }
    for (const std::string_view name : kCoordinates) {
      cloud.fields.push_back({std::string(name), FieldType::float64, 1, cloud.stride});
      cloud.stride += sizeof(double);
    }
    return cloud;
  }
  const auto names = column_names(table.rows, table.header, input, source);
  const auto is_colour = [](std::string_view name) {
    return name == "red" || name == "green" || name == "blue";
  };
  // Colours of an array may be fractions of full brightness. Black is then 0, and white is 1.
  bool shares = source == RowSource::array;  // mutant: cloud-colours
  for (std::size_t k = 0; k < names.size(); ++k)
    if (is_colour(names[k])) shares = shares && all_in_column(table.rows, k, is_share);
  std::vector<bool> is_coordinate;
  for (std::size_t k = 0; k < names.size(); ++k) {
    is_coordinate.push_back(std::count(kCoordinates.begin(), kCoordinates.end(), names[k]) > 0);
    const bool bytes = is_colour(names[k]) && !shares && all_in_column(table.rows, k, is_byte);
    const FieldType type = bytes ? FieldType::uint8 : FieldType::float64;
    cloud.fields.push_back({names[k], type, 1, cloud.stride});
    cloud.stride += size_of(type);
  }
  const auto rows = static_cast<std::size_t>(cloud.width);
  input.require_memory(rows * cloud.stride);
  cloud.data.resize(rows * cloud.stride);
  std::byte* record = cloud.data.data();
  for (std::size_t i = 0; i < rows; ++i, record += cloud.stride) {
    const double* row = table.rows.data() + i * names.size();
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (is_coordinate[k] && std::isinf(row[k])) {
        input.fail(
            {fmt::format("infinite coordinate of point {}", i), {}, "a finite number or nan", {}});
      }
      if (cloud.fields[k].type == FieldType::uint8) {
        record[cloud.fields[k].offset] = static_cast<std::byte>(row[k]);
      } else {
        std::memcpy(record + cloud.fields[k].offset, row + k, sizeof(double));
      }
    }
  }
  return cloud;
}

bool is_counted(const Input& input) {
  const std::string_view probe = input.text().substr(0, 4096);
  if (probe.find('\0') != std::string_view::npos) return false;
  TextLines lines(input);
  const auto cells = [&] {
    std::size_t count = 0;
    if (lines.next()) {
      std::string_view rest = lines.line();
      while (!rest.empty()) {
        const std::size_t blank = std::min(rest.find_first_of(" \t,;"), rest.size());
        if (blank > 0) ++count;
        rest.remove_prefix(std::min(blank + 1, rest.size()));
      }
    }
    return count;
  };
  const bool number =
      cells() == 1 && lines.line().find_first_not_of("0123456789") == std::string_view::npos;
  return number && cells() != 1;
}

}  // namespace detail

Cloud read_xyz(const Input& input, const ReadOptions& options) {
  if (detail::is_molecule(input)) return detail::read_molecule(input, options);
  ReadOptions as_points = options;
  as_points.array = ArrayMeaning::points;
  as_points.columns.clear();
  detail::TableLayout layout = detail::table_layout(input, as_points);
  // Readers of clouds always read all columns. The notes must therefore not suggest choosing some
  // of them.
  for (Message& note : layout.notes) note = note.without(Setting::columns);
  detail::TextTable table = detail::read_text_table(input, Allow::any, options, false, &layout);
  if (table.header.size() == layout.width && layout.names_rows)
    table.header.erase(table.header.begin(),
                       table.header.begin() + static_cast<std::ptrdiff_t>(layout.columns.front()));
  return detail::cloud_of_rows(table, input, options, detail::RowSource::text);
}

Cloud read_pts(const Input& input, const ReadOptions& options) {
  return detail::cloud_of_rows(detail::read_text_table(input, Allow::any, options, true), input,
                               options, detail::RowSource::pts);
}

}  // namespace ph
