// SPDX-License-Identifier: MIT
// What text and arrays hold that do not say it themselves. Where two readings make sense, one of
// them is taken with a note, or none: never one in silence.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "array.hpp"
#include "readers.hpp"
#include "table.hpp"

namespace ph::detail {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr Index kMostCoordinates = 16;  // of points in an array that may be an image
constexpr Index kSlender = 4;           // so many times more rows than columns it has then

double number_of(std::string_view cell) {
  cell = without_quotes(cell);
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = kUnknown;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

// Lengths of the first rows: they tell a triangle of a matrix from what cannot be ragged.
std::optional<Format> triangle_of(const Input& input) {
  TextLines lines(input);
  Cells cells(lines);
  std::vector<std::size_t> lengths;
  bool first = true;
  while (lengths.size() < kMostLookedAt && lines.next()) {
    if (std::exchange(first, false) && !header_names(lines.line()).empty()) continue;
    if (lines.line().find(':') != std::string_view::npos) return Format::simplices;
    std::size_t length = 0;
    for (cells.start(); cells.more(); ++length) cells.skip();
    lengths.push_back(length);
  }
  if (lengths.size() < 3) return std::nullopt;
  bool rising = lengths[0] == 1, falling = true;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    rising = rising && lengths[i] == i + 1;
    falling = falling && lengths[i] + i == lengths[0];
  }
  if (rising) return Format::lower_distance;
  if (falling) return Format::upper_distance;
  return std::nullopt;
}

// The rows of a table, each as long as the first one; nothing if one is not among those looked at.
std::optional<std::size_t> count_rows(const Input& input, const TableLayout& layout,
                                      std::size_t most, std::vector<double>& block,
                                      bool& same_names) {
  const std::size_t side = std::min(layout.columns.size(), kMostLookedAt);
  const std::vector<bool> taken = layout.taken();
  TextLines lines(input);
  Cells cells(lines);
  std::size_t rows = 0;
  same_names = layout.names_rows && layout.header.size() == layout.width;
  for (bool more = layout.start(lines); more && rows <= most; more = lines.next(), ++rows) {
    if (rows >= side) continue;
    std::size_t length = 0, column = 0;
    for (cells.start(); cells.more() && length < layout.width; ++length) {
      const std::string_view cell = cells.skip();
      if (length == 0) same_names = same_names && without_quotes(cell) == layout.header[rows + 1];
      if (taken[length] && column < side) {
        block[rows * side + column++] = number_of(cell);
      }
    }
    const bool is_short =
        length != layout.width && !(length + 1 == layout.width && ends_empty(lines.line()));
    if (is_short || cells.more()) return std::nullopt;
  }
  return rows;
}

}  // namespace

TextGuess guess_text(const Input& input, const ReadOptions& options) {
  TextGuess guess;
  if (options.columns.empty()) {
    if (const auto format = triangle_of(input)) {
      guess.format = *format;
      return guess;
    }
  }
  const TableLayout layout = table_layout(input, options);
  const std::size_t n = layout.columns.size();
  if (n == 0) return guess;
  const std::size_t side = std::min(n, kMostLookedAt);
  std::vector<double> block(side * side, kUnknown);
  bool same_names = false;
  const auto rows = count_rows(input, layout, n, block, same_names);
  guess.rows = rows.value_or(0);
  guess.columns = n;
  if (n < 2 || guess.rows != n) return guess;
  guess.same_names = same_names;
  guess.square = kind_of_square(block, side);
  // Two rows say too little: two points of the plane may well be symmetric.
  if (n < 3) return guess;
  if (guess.square == SquareKind::distances || guess.square == SquareKind::zeros)
    guess.format = Format::distance;
  return guess;
}

ArrayGuess guess_array(const Input& input, const ReadOptions& options) {
  const ReadOptions& o = options;
  if (!matrix_option(o).empty()) return {ArrayMeaning::distances, {}};
  if (o.array == ArrayMeaning::image || o.array == ArrayMeaning::points ||
      o.array == ArrayMeaning::distances)
    return {o.array, {}};
  const bool is_rips = o.array == ArrayMeaning::rips;
  const ArrayGuess otherwise{
      is_rips || !o.columns.empty() ? ArrayMeaning::points : ArrayMeaning::image, {}};
  const NpyLayout npy = npy_layout(input);
  if (npy.shape.size() == 3 && !is_rips) {
    const Index rows = npy.shape[1], columns = npy.shape[2];
    if (npy.kind == 'f' && columns > 0 && columns <= kMostCoordinates && rows >= kSlender * columns)
      return {ArrayMeaning::image,
              fmt::format("an array of three axes: read as a volume; points are an array of two, "
                          "a[i] of these {} sets of {} x {}?",
                          npy.shape[0], rows, columns)};
    if (npy.kind == 'u' && npy.array.type.size == 1 && (columns == 3 || columns == 4))
      return {ArrayMeaning::image,
              fmt::format("an array of three axes: read as a volume; of a picture with {} channels "
                          "take one, a[..., 0]",
                          columns)};
  }
  if (npy.shape.size() != 2 || npy.count == 0 || !o.columns.empty()) return otherwise;
  const Index rows = npy.shape[0], columns = npy.shape[1];
  const std::string shape = fmt::format("{} x {} array", rows, columns);
  if (rows == columns && rows >= 2) {
    const auto n = static_cast<std::size_t>(rows);
    const std::size_t side = std::min(n, kMostLookedAt);
    std::vector<double> block;
    for (std::size_t i = 0; i < side; ++i) {
      for (std::size_t j = 0; j < side; ++j) {
        const std::size_t y = i * n / side, x = j * n / side;
        const std::size_t place = npy.array.first_axis_fastest ? x * n + y : y * n + x;
        bool exact = true;
        block.push_back(npy.array.type.load(
            input.bytes().data() + npy.array.offset + place * npy.array.type.size, npy.array.order,
            exact));
      }
      input.done_with(0, input.size());
    }
    const SquareKind kind = kind_of_square(block, side);
    const std::string_view instead =
        is_rips ? "--format points reads a point a row" : "--complex cubical reads an image";
    if (n < 3) {
      const bool either = kind == SquareKind::distances || kind == SquareKind::correlations;
      if (!either) return otherwise;
      return {otherwise.meaning,
              fmt::format("{}, symmetric: read as {}; --format distance reads distances", shape,
                          is_rips ? "points" : "an image")};
    }
    if (kind == SquareKind::distances && !is_mostly_zero(block, side)) {
      return {
          ArrayMeaning::distances,
          fmt::format("{}, symmetric with a zero diagonal: read as distances; {}", shape, instead)};
    }
    if (kind == SquareKind::correlations) {
      input.fail({"correlations, points or an image",
                  fmt::format("a symmetric {} from -1 to 1 with ones on its diagonal", shape),
                  "an option that says which",
                  "--from-correlation takes distances 1 - r; --complex cubical reads an image, "
                  "--format points a point a row"});
    }
    if (kind == SquareKind::distances || kind == SquareKind::symmetric) {
      return {otherwise.meaning,
              fmt::format("{}, symmetric: read as {}; --format distance reads distances", shape,
                          is_rips ? "points, one a row" : "an image")};
    }
  }
  const bool is_slender = columns <= kMostCoordinates && rows >= kSlender * columns;
  if (!is_slender || is_rips) return otherwise;
  // Pictures and maps of labels have small integers, coordinates hardly ever.
  const bool is_of_pixels = npy.array.type.size <= 2 && npy.kind != 'f';
  if (is_of_pixels)
    return {
        ArrayMeaning::image,
        fmt::format("{} of small integers: read as an image; --complex rips reads a point a row",
                    shape)};
  return {ArrayMeaning::points,
          fmt::format("{}: read as a point a row; --complex cubical reads an image", shape)};
}

}  // namespace ph::detail
