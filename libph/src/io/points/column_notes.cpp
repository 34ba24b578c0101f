// SPDX-License-Identifier: MIT
// Notes on columns and rows of a table that were read as coordinates but may be something else.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

// True if a column counts the rows, from 0 or from 1.
bool counts_rows(PointsView points, Index column) {
  for (Index i = 0; i < points.rows(); ++i)
    if (points(i, column) != points(0, column) + static_cast<double>(i)) return false;
  return points(0, column) == 0 || points(0, column) == 1;
}

// True if a column has the name of a coordinate or of a time.
bool names_coordinate(std::string_view name) {
  constexpr std::array<std::string_view, 10> kNames{"x", "y", "z", "X",    "Y",
                                                    "Z", "t", "T", "time", "Time"};
  return std::ranges::find(kNames, name) != kNames.end();
}

// True if the first row may be a header that numbers the columns: 0, 1, 2, … or 1, 2, 3, …. A row
// of one or two integers may be a header only if one of the next rows contains a fraction.
bool may_be_header(PointsView rows) {
  const Index columns = rows.cols();
  if (rows.rows() < 2 || columns == 0 || (rows(0, 0) != 0 && rows(0, 0) != 1)) return false;
  for (Index k = 1; k < columns; ++k)
    if (rows(0, k) != rows(0, 0) + static_cast<double>(k)) return false;
  if (columns > 2) return true;
  for (Index i = 1; i < std::min<Index>(rows.rows(), 9); ++i)
    for (Index k = 0; k < columns; ++k)
      if (rows(i, k) != std::floor(rows(i, k))) return true;
  return false;
}

// True if the first row consists of digits and separators, as a header that numbers the columns
// does. A cell such as 0.0 is always a value.
bool begins_with_digits(const Input& input) {
  TextLines lines(input);
  return lines.next() &&
         lines.line().find_first_not_of("0123456789\",; \t") == std::string_view::npos;
}

// "a", "a and b" or "a, b and c".
std::string listed(std::vector<std::string> words) {
  if (words.size() == 1) return words.front();
  const std::string last = std::move(words.back());
  words.pop_back();
  return fmt::format("{} and {}", fmt::join(words, ", "), last);
}

// Adds a note if a table names x and y, possibly z, and other columns, which are read as
// coordinates as well.
void tell_of_other_columns(const TableLayout& layout, const ReadOptions& options) {
  if (!options.columns.empty() || layout.header.size() != layout.width) return;
  std::vector<std::string> coordinates, others;
  for (const std::size_t k : layout.columns) {
    const std::string& name = layout.header[k];
    const std::string lower = lower_case(name);
    const bool is_coordinate = lower == "x" || lower == "y" || lower == "z";
    (is_coordinate ? coordinates : others).push_back(is_coordinate ? name : printable(name, 40));
  }
  const auto has = [&](std::string_view name) {
    return std::ranges::count_if(coordinates,
                                 [&](const auto& found) { return lower_case(found) == name; }) == 1;
  };
  if (others.empty() || !has("x") || !has("y") || coordinates.size() != (has("z") ? 3U : 2U))
    return;
  constexpr std::size_t most_named = 3;
  const std::size_t named = others.size() > most_named ? most_named - 1 : others.size();
  std::vector<std::string> words(others.begin(),
                                 others.begin() + static_cast<std::ptrdiff_t>(named));
  if (named < others.size()) words.push_back(fmt::format("{} more", others.size() - named));
  note(options,
       Message::guess(fmt::format(
           "{} {} read as {}; {} leaves {} out", listed(words), others.size() == 1 ? "is" : "are",
           others.size() == 1 ? "a coordinate" : "coordinates",
           mark(Setting::columns, fmt::format("{}", fmt::join(coordinates, ","))),
           others.size() == 1 ? "it" : "them")));
}

// Adds a note if a table has a latitude and a longitude, which are read as coordinates of the
// plane.
void tell_of_degrees(const TableLayout& layout, const ReadOptions& options) {
  if (layout.header.size() != layout.width) return;
  // The name of the only column with one of these names; empty if there is none.
  const auto column_named = [&](std::initializer_list<std::string_view> names) -> std::string {
    std::string found;
    for (const std::size_t k : layout.columns) {
      if (std::ranges::count(names, lower_case(layout.header[k])) == 0) continue;
      if (!found.empty()) return {};
      found = layout.header[k];
    }
    return found;
  };
  const std::string latitude = column_named({"lat", "latitude"});
  const std::string longitude = column_named({"lon", "lng", "long", "longitude"});
  if (latitude.empty() || longitude.empty()) return;
  note(options, Message::guess(fmt::format(
                    "{0} and {1} are read as coordinates of the plane, but differences of "
                    "degrees are not distances; (cos {0} cos {1}, cos {0} sin {1}, sin "
                    "{0}) is the point on the unit sphere",
                    latitude, longitude)));
}

}  // namespace

void tell_of_counts(const Input& input, const TableLayout& layout, PointsView rows,
                    const ReadOptions& options) {
  constexpr Index kFewest = 8;  // in this many rows, a column rarely counts the rows by chance
  if (!options.columns.empty()) return;
  const bool is_image = options.array == ArrayMeaning::image;
  const bool has_name = !layout.header.empty() && layout.header.size() == layout.width;
  const bool may_be_index =
      !layout.names_rows && !(has_name && names_coordinate(layout.header.front()));
  if (may_be_index && rows.rows() >= kFewest && rows.cols() > 1 && counts_rows(rows, 0)) {
    note(options, Message::guess(fmt::format(
                      "the first column{} holds row numbers and is read as {}; {} leaves it out",
                      has_name ? fmt::format(", {},", printable(layout.header.front(), 40)) : "",
                      is_image ? "values" : "a coordinate",
                      mark(Setting::columns, fmt::format("2-{}", rows.cols())))));
  }
  if (layout.header.empty() && may_be_header(rows) && begins_with_digits(input))
    note(options, Message::guess(
                      fmt::format("the first row {} and is read as {}; remove it if it is a header",
                                  rows.cols() == 1 ? "is a whole number" : "holds column numbers",
                                  is_image ? "values" : "a point")));
}

void tell_of_whole_columns(PointsView points, const ReadOptions& options) {
  constexpr Index kFewest = 8, kSpace = 3, kMost = 7;  // x y z, intensity, red green blue
  const Index columns = points.cols();
  if (!options.columns.empty() || points.rows() < kFewest || columns <= kSpace || columns > kMost)
    return;
  for (Index k = 0; k < columns; ++k) {
    bool is_whole = true;
    for (Index i = 0; i < points.rows() && is_whole; ++i)
      is_whole = std::floor(points(i, k)) == points(i, k);
    if (is_whole != (k >= kSpace)) return;
  }
  const std::string which =
      columns == kSpace + 1 ? "column 4 has" : fmt::format("columns 4 to {} have", columns);
  note(options,
       Message::guess(fmt::format(
           "{} only whole numbers, unlike the first three, and {} read as {}; {} leaves {} out",
           which, columns == kSpace + 1 ? "is" : "are",
           columns == kSpace + 1 ? "a coordinate" : "coordinates", mark(Setting::columns, "1-3"),
           columns == kSpace + 1 ? "it" : "them")));
}

void tell_of_columns(const TableLayout& layout, PointsView rows, const ReadOptions& options) {
  tell_of_other_columns(layout, options);
  tell_of_degrees(layout, options);
  if (layout.header.empty()) tell_of_whole_columns(rows, options);
}

}  // namespace ph::detail
