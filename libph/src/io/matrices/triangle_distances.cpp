// SPDX-License-Identifier: MIT
// Reads triangles of distance matrices, as text and as float32.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/matrices/distance_rows.hpp"
#include "ph/detail/io/table.hpp"

namespace ph {
namespace {

using detail::fail_row;
using detail::TextEntries;
using detail::triangle;

// The n with n (n - 1) / 2 == pairs, if such a number exists.
std::optional<std::size_t> points_of_pairs(std::size_t pairs) {
  const auto root = std::sqrt(8.0 * static_cast<double>(pairs) + 1.0);
  const auto guess = static_cast<std::size_t>((1.0 + root) / 2.0);
  for (std::size_t n = std::max<std::size_t>(guess, 2) - 1; n <= guess + 1; ++n) {
    if (n > 0 && triangle(n) == pairs) return n;
  }
  return std::nullopt;
}

// Moves to the first row of the triangle, and skips a header, which is a row of names. @return
// false if the input has no data.
bool first_row(TextLines& lines, const ReadOptions& options) {
  if (!lines.next()) return false;
  if (header_names(lines.line()).empty()) return true;
  detail::note(options, fmt::format("line {} is a header: skipped", lines.number()));
  return lines.next();
}

// Reads all pairs from one line, in the order of the rows of a triangle.
DistanceMatrix from_one_line(const TextLines& lines, std::size_t line, std::vector<double> values,
                             bool lower) {
  const auto points = points_of_pairs(values.size());
  if (!points) {
    lines.input().fail_at(line, 1,
                          {"not a triangle",
                           fmt::format("one line of {} cells", values.size()),
                           "one row per line, or n(n-1)/2 cells",
                           {}});
  }
  const std::size_t n = *points;
  if (!lower) {
    lines.input().require_memory(values.size() * sizeof(double));
    std::vector<double> pairs(values.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) pairs[triangle(j) + i] = values[next++];
    }
    values = std::move(pairs);
  }
  return DistanceMatrix(static_cast<Index>(n), std::move(values));
}

// Reads the rows of the lower triangle after the first row, which has one cell.
DistanceMatrix read_lower_rows(TextLines& lines, TextEntries& entries, std::vector<double> values,
                               const ReadOptions& options) {
  std::size_t n = 2;
  do {
    entries.start();
    std::size_t k = 0;
    for (; entries.more(); ++k) {
      if (k < n) {
        values.push_back(entries.next());
      } else {
        entries.skip();
      }
    }
    if (k != n) fail_row(lines, n, k, n);
    ++n;
  } while (lines.next());
  entries.finish();
  bool are_zero = true;
  for (std::size_t i = 1; i < n; ++i) are_zero = are_zero && values[triangle(i + 1) - 1] == 0;
  if (are_zero && n > 3)
    detail::note(options,
                 "each row ends in 0, which means equal points; if these zeros are the diagonal, "
                 "leave out the zeros and the first row");
  return DistanceMatrix(static_cast<Index>(n), std::move(values));
}

// Reads the rows of the upper triangle after the first row. Each row becomes a column of the lower
// triangle.
DistanceMatrix read_upper_rows(TextLines& lines, TextEntries& entries,
                               const std::vector<double>& first, const ReadOptions& options) {
  const std::size_t n = first.size() + 1;
  std::vector<double> pairs = detail::make_triangle(lines.input(), n, n - 1, triangle(n), options);
  for (std::size_t j = 1; j < n; ++j) pairs[triangle(j)] = first[j - 1];
  std::size_t row = 1;
  do {
    const std::size_t expected = row < n ? n - 1 - row : 0;
    entries.start();
    std::size_t k = 0;
    for (; entries.more(); ++k) {
      if (k < expected) {
        pairs[triangle(row + 1 + k) + row] = entries.next();
      } else {
        entries.skip();
      }
    }
    if (k != expected) fail_row(lines, row, k, expected);
    ++row;
  } while (lines.next());
  if (row + 1 < n) {
    lines.input().fail({"truncated matrix", fmt::format("{} rows", row), fmt::format("{}", n - 1),
                        "the upper triangle has n-1, …, 2, 1 cells per row"});
  }
  entries.finish();
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs));
}

DistanceMatrix read_triangle(const Input& input, const ReadOptions& options, bool lower) {
  TextLines lines(input);
  if (!first_row(lines, options)) return detail::no_points(input, options);
  TextEntries entries(lines, options);
  std::vector<double> first;
  // Memory is reserved for as many pairs as the number of lines suggests, but never for more than
  // the input can contain.
  if (lower) {
    const std::string_view text = input.text();
    const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 2;
    const std::size_t most = std::min(triangle(std::min(rows, text.size() + 2)), text.size() + 1);
    input.require_memory(most * sizeof(double));
    first.reserve(most);
  }
  entries.start();
  while (entries.more()) first.push_back(entries.next());
  const std::size_t first_line = lines.number();
  if (!lines.next()) {
    entries.finish();
    return from_one_line(lines, first_line, std::move(first), lower);
  }
  if (!lower) return read_upper_rows(lines, entries, first, options);
  if (first.size() != 1) {
    input.fail_at(first_line, 1,
                  {"row 1 of the matrix is too long", fmt::format("{} cells", first.size()), "1",
                   "the lower triangle has 1, 2, 3, … cells per row"});
  }
  return read_lower_rows(lines, entries, std::move(first), options);
}

}  // namespace

std::string detail::way_to_raw_points(const Input& input) {
  std::vector<std::size_t> widths;
  for (const std::size_t width : {4, 3, 5, 6})  // KITTI, x y z, nuScenes, x y z with normals
    if (input.size() > 0 && input.size() % (width * sizeof(float)) == 0) widths.push_back(width);
  if (widths.empty()) return {};
  const std::size_t numbers = input.size() / sizeof(float), first = widths.front();
  std::string way = fmt::format("{} reads {} point{} of {} numbers",
                                mark(Setting::raw_points, fmt::format("{}", first)),
                                numbers / first, numbers == first ? "" : "s", first);
  widths.erase(widths.begin());
  if (widths.empty()) return way;
  const std::size_t last = widths.back();
  widths.pop_back();
  return way + fmt::format("; {}{}{} also divide{} its {} numbers", fmt::join(widths, ", "),
                           widths.empty() ? "" : " and ", last, widths.empty() ? "s" : "", numbers);
}

DistanceMatrix read_lower_distances(const Input& input, const ReadOptions& options) {
  return read_triangle(input, options, true);
}

DistanceMatrix read_upper_distances(const Input& input, const ReadOptions& options) {
  return read_triangle(input, options, false);
}

DistanceMatrix read_binary_distances(const Input& input, const ReadOptions& options) {
  if (input.size() == 0) return detail::no_points(input, options);
  // Points are often in files with the same extension, for example those of laser scanners.
  std::string way_to_points = detail::way_to_raw_points(input);
  if (way_to_points.empty()) way_to_points = mark(Setting::raw_points, "D") + " reads points";
  const std::size_t count = input.size() / sizeof(float);
  const auto points = points_of_pairs(count);
  if (input.size() % sizeof(float) != 0 || !points) {
    input.fail({"truncated or not a triangle", fmt::format("{} bytes", input.size()),
                "4 n(n-1)/2 bytes: float32, little endian, the lower triangle", way_to_points});
  }
  const auto fail = [&](std::size_t byte, Fault fault) {
    fault.hint = (fault.hint.empty() ? "" : fault.hint.marked() + "; ") + way_to_points;
    input.fail_at_byte(byte, fault);
  };
  input.require_memory(count * sizeof(double));
  std::vector<double> pairs(count);
  detail::MatrixEntries entries(options);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t byte = k * sizeof(float);
    const auto raw = load<float>(input.bytes().data() + byte, std::endian::little);
    pairs[k] =
        entries.distance(double{raw}, {1, 0, byte}, [&](const Fault& fault) { fail(byte, fault); });
  }
  entries.finish(
      [&](const detail::EntryPlace& place, const Fault& fault) { fail(place.byte, fault); });
  return DistanceMatrix(static_cast<Index>(*points), std::move(pairs));
}

DistanceMatrix read_lower_distances(const std::filesystem::path& path, const ReadOptions& options) {
  return read_lower_distances(Input::open(path, options.context, Input::Excess::refused,
                                          detail::start_check(Format::lower_distance)),
                              options);
}
DistanceMatrix read_upper_distances(const std::filesystem::path& path, const ReadOptions& options) {
  return read_upper_distances(Input::open(path, options.context, Input::Excess::refused,
                                          detail::start_check(Format::upper_distance)),
                              options);
}
DistanceMatrix read_binary_distances(const std::filesystem::path& path,
                                     const ReadOptions& options) {
  return read_binary_distances(Input::open(path, options.context), options);
}

}  // namespace ph
