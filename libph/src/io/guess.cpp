// SPDX-License-Identifier: MIT
// Guesses the meaning of a text or an array that does not declare it. If two meanings are
// plausible, either one of them is chosen with a note, or the input is refused. No meaning is
// chosen silently.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/points/npy_header.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

// The largest number of columns of an array that is read as points without a request.
constexpr Index kMostCoordinates = 16;
// An array is read as points if the number of rows is at least this many times the number of
// columns.
constexpr Index kSlender = 4;

// The smallest width and height of an array that may be a picture whose first axis has the
// channels.
constexpr Index kSmallestPicture = 16;

// Recognises a triangle of a matrix by the lengths of the first rows, because no other table may
// have rows of different lengths. A colon indicates a list of simplices.
std::optional<Format> triangle_of(const Input& input) {
  TextLines lines(input);
  std::vector<std::size_t> lengths;
  bool first = true;
  while (lengths.size() < kMostLookedAt && lines.next()) {
    if (std::exchange(first, false) && !header_names(lines.line()).empty()) continue;
    if (lines.line().find(':') != std::string_view::npos) return Format::simplices;
    const char separator = separator_in(lines.line());
    lengths.push_back(count_cells(lines, separator == '\t' ? ' ' : separator));
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

}  // namespace

std::string way_to_distances(bool has_zero_diagonal) {
  const std::string format = mark(Setting::format, "distance");
  return has_zero_diagonal ? format : format + ' ' + mark(Setting::diagonal, "zero");
}

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
  guess.columns = n;
  guess.table = shape_of(input, layout);
  const SquareKind square = guess.table.square;
  // Two rows are not enough, because the coordinates of two points in the plane may happen to form
  // a symmetric matrix.
  if (n > 2 && (square == SquareKind::distances || square == SquareKind::zeros))
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
  ArrayGuess otherwise{is_rips || !o.columns.empty() ? ArrayMeaning::points : ArrayMeaning::image,
                       {}};
  if (is_npy_of_records(input)) return {ArrayMeaning::points, {}};
  const NpyLayout npy = npy_layout(input);
  if (npy.shape.size() == 3 && !is_rips) {
    const Index rows = npy.shape[1], columns = npy.shape[2];
    const bool may_be_sets = columns <= kMostCoordinates && rows >= kSlender * columns;
    if (npy.kind == 'f' && columns == 3 && npy.count > 0)
      return {ArrayMeaning::image,
              Message::guess(fmt::format(
                  "an array of three axes: read as a volume; {} reads {} x {} points with "
                  "three coordinates each{}",
                  mark(Setting::format, "points"), npy.shape[0], rows,
                  may_be_sets ? "; if it holds several sets of points, take one set, a[i]" : ""))};
    if (npy.kind == 'f' && columns > 0 && may_be_sets)
      return {ArrayMeaning::image,
              Message::guess(
                  fmt::format("an array of three axes: read as a volume; if it holds {} sets of "
                              "{} x {} points, take one set, a[i]",
                              npy.shape[0], rows, columns))};
    const bool are_bytes = npy.kind == 'u' && npy.array.type.size == 1;
    const auto picture_of = [](Index channels, std::string_view first) {
      return ArrayGuess{ArrayMeaning::image,
                        Message::guess(fmt::format(
                            "an array of three axes: read as a volume; if it is a picture with {} "
                            "channels, take one channel, {}",
                            channels, first))};
    };
    if (are_bytes && (columns == 3 || columns == 4)) return picture_of(columns, "a[..., 0]");
    if (const Index sheets = npy.shape[0];
        are_bytes && (sheets == 3 || sheets == 4) && std::min(rows, columns) >= kSmallestPicture)
      return picture_of(sheets, "a[0]");
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
    const bool is_nearly =
        kind == SquareKind::nearly_correlations || kind == SquareKind::nearly_symmetric;
    const std::string_view symmetric = is_nearly ? "nearly symmetric" : "symmetric";
    const std::string instead = is_rips
                                    ? mark(Setting::format, "points") + " reads one point per row"
                                    : mark(Setting::complex, "cubical") + " reads an image";
    if (n < 3) {
      const bool either = kind == SquareKind::distances || kind == SquareKind::correlations;
      if (!either) return otherwise;
      return {otherwise.meaning,
              Message::guess(fmt::format("{}, symmetric: read as {}; {} reads distances", shape,
                                         is_rips ? "points" : "an image",
                                         mark(Setting::format, "distance")))};
    }
    const bool has_zeros = kind == SquareKind::distances || kind == SquareKind::zeros;
    // A picture may be black and a label map may be empty, but points and distances are never all
    // zero.
    const bool is_sure = is_rips || (!is_mostly_zero(block, side) &&
                                     (kind == SquareKind::distances || npy.kind == 'f'));
    if (has_zeros && is_sure) {  // mutant: guess-damaged
      // The reader of distances refuses matrices that are asymmetric or have negative entries.
      return {ArrayMeaning::distances,
              fmt::format("{}{} with a zero diagonal: read as distances; {}", shape,
                          kind == SquareKind::distances ? ", symmetric" : "", instead)};
    }
    if (kind == SquareKind::zeros && (npy.kind == 'f' || !is_mostly_zero(block, side))) {
      return {otherwise.meaning,
              Message::guess(
                  fmt::format("{} with a zero diagonal: read as an image; {} reads distances",
                              shape, mark(Setting::format, "distance")))};
    }
    if (kind == SquareKind::correlations || kind == SquareKind::nearly_correlations) {
      input.fail({"correlations, points or an image",
                  fmt::format("a {} {} with values from -1 to 1 and ones on its diagonal",
                              symmetric, shape),
                  "an option that says which",
                  fmt::format("{} reads correlations r as distances 1 - r; {} reads an image, {} "
                              "one point per row",
                              mark(Setting::from_correlation), mark(Setting::complex, "cubical"),
                              mark(Setting::format, "points"))});
    }
    if (kind == SquareKind::distances || kind == SquareKind::symmetric ||
        kind == SquareKind::nearly_symmetric) {
      return {otherwise.meaning,
              Message::guess(fmt::format("{}, {}: read as {}; {} reads distances", shape, symmetric,
                                         is_rips ? "points, one per row" : "an image",
                                         way_to_distances(kind == SquareKind::distances)))};
    }
  }
  if (is_rips) return otherwise;
  // mutant: guess-slender
  const bool is_slender = columns <= kMostCoordinates && rows >= kSlender * columns;
  // Pictures and label maps have small integers, but coordinates are rarely small integers.
  const bool is_of_pixels = npy.array.type.size <= 2 && npy.kind != 'f';
  if (!is_slender) {
    if (is_of_pixels || rows < 2 || columns < 2) return otherwise;
    return {ArrayMeaning::image, fmt::format("{}: read as an image; {} reads one point per row",
                                             shape, mark(Setting::complex, "rips"))};
  }
  if (is_of_pixels)
    return {ArrayMeaning::image,
            Message::guess(
                fmt::format("{} of small integers: read as an image; {} reads one point per row",
                            shape, mark(Setting::complex, "rips")))};
  return {ArrayMeaning::points, fmt::format("{}: read as one point per row; {} reads an image",
                                            shape, mark(Setting::complex, "cubical"))};
}

}  // namespace ph::detail
