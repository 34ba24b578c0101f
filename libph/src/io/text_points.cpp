// SPDX-License-Identifier: MIT
#include "readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ph/io/cloud_io.hpp"

namespace ph {

namespace detail {

TextTable read_text_table(const Input& input, Allow allow, const ReadOptions& options,
                          bool counted) {
  TextTable table;
  TextLines lines(input);
  Cells cells(lines);
  bool more = lines.next();
  std::size_t said = 0;
  if (counted) {
    if (!more) input.fail({"no number of points", "nothing", "it on the first line", {}});
    cells.start();
    const auto most = static_cast<std::int64_t>(input.size());  // a point takes a few bytes
    said = static_cast<std::size_t>(cells.integer(0, most, "number of points"));
    cells.expect_end("the number of points alone");
    more = lines.next();
  } else if (more) {
    table.header = header_names(lines.line());
    if (!table.header.empty()) {
      note(options, fmt::format("line {} is a header: skipped", lines.number()));
      more = lines.next();
    }
  }
  const auto check_count = [&](std::size_t count) {
    if (!counted || count == said) return;
    input.fail({count < said ? "truncated" : "trailing data",
                fmt::format("{} points", count),
                fmt::format("{}, as the first line says", said),
                {}});
  };
  if (!more) {
    check_count(0);
    return table;
  }

  const std::size_t first_line = lines.number();
  std::vector<double> first_row;
  cells.start();
  while (cells.more()) first_row.push_back(cells.number(allow));
  const std::size_t columns = first_row.size();

  // No more rows than lines, and a row takes two bytes a cell: memory is at most four times the
  // file, whatever it holds.
  const std::string_view rest = input.text().substr(lines.offset());
  const std::size_t by_lines =
      static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 2;
  const std::size_t most = std::min(by_lines, rest.size() / (2 * columns) + 2);
  input.require_memory(most * columns * sizeof(double));
  table.rows.resize(static_cast<Index>(most), static_cast<Index>(columns));
  double* row = std::copy(first_row.begin(), first_row.end(), table.rows.data());
  std::size_t count = 1;
  while (lines.next()) {
    cells.start();
    std::size_t k = 0;
    while (cells.more()) {
      if (k == columns) break;
      row[k++] = cells.number(allow);
    }
    if (k != columns || cells.more()) {
      while (cells.more()) {
        cells.word();
        ++k;
      }
      lines.fail(lines.line().data(),
                 {"ragged row", fmt::format("{} cell{}", k, k == 1 ? "" : "s"),
                  fmt::format("{}, as in line {}", columns, first_line),
                  k < columns && lines.offset() == input.size() ? "is the file truncated?" : ""});
    }
    row += columns;
    ++count;
  }
  check_count(count);
  table.rows.conservativeResize(static_cast<Index>(count), Eigen::NoChange);
  if (!table.header.empty() && table.header.size() != columns && columns > 1 &&
      table.header.size() > 1) {
    note(options,
         fmt::format("the header has {} names for {} columns", table.header.size(), columns));
  }
  return table;
}

Points without_nan_rows(Points points, const Input& input, const ReadOptions& options, bool holes) {
  const Index columns = points.cols();
  Index kept = 0;
  for (Index i = 0; i < points.rows(); ++i) {
    double* row = points.data() + i * columns;
    bool hole = false;
    for (Index k = 0; k < columns; ++k) {
      if (std::isinf(row[k])) {
        input.fail({fmt::format("infinite coordinate {} of point {}", k, i),
                    row[k] > 0 ? "inf" : "-inf",
                    "a finite number",
                    {}});
      }
      if (!std::isnan(row[k])) continue;
      hole = true;
      if (!holes && options.nan == NanPolicy::error) {
        input.fail({fmt::format("coordinate {} of point {}", k, i), "NaN", "a finite number",
                    "--nan drop leaves such points out"});
      }
    }
    if (hole) {
      if (options.dropped != nullptr) options.dropped->push_back(i);
    } else {
      if (kept != i) std::copy(row, row + columns, points.data() + kept * columns);
      ++kept;
    }
  }
  if (kept != points.rows()) {
    note(options, fmt::format("{} of {} points have a NaN coordinate: left out",
                              points.rows() - kept, points.rows()));
    points.conservativeResize(kept, Eigen::NoChange);
  }
  return points;
}

}  // namespace detail

Points read_points(const Input& input, const ReadOptions& options) {
  Points points;
  if (detail::is_npy(input) || detail::is_npz(input)) {
    const Image array = detail::read_npy_array(input);
    if (array.dim() != 2) {
      input.fail({"not a set of points",
                  fmt::format("an array of {} dimensions", array.dim()),
                  "2: a point a row",
                  {}});
    }
    if (array.values.empty() && array.extents[0] > 0) {
      input.fail({"points without coordinates",
                  fmt::format("shape ({}, 0)", array.extents[0]),
                  "one column at least",
                  {}});
    }
    // Both are there for a while, and no budget counts the array.
    input.require_memory(array.values.bytes() + array.values.size() * sizeof(double));
    points.resize(array.extents[0], array.extents[1]);
    with_voxels(array.values.type(), array.values.data(), [&](const auto* numbers) {
      constexpr std::size_t block = 1 << 16;  // numbers between two looks at the stop token
      for (std::size_t k = 0; k < array.values.size(); k += block) {
        input.poll(input.size());
        const std::size_t count = std::min(block, array.values.size() - k);
        std::copy_n(numbers + k, count, points.data() + k);
      }
    });
    points = detail::without_nan_rows(std::move(points), input, options, false);
  } else if (detail::is_pcd(input) || detail::is_ply(input)) {
    points = detail::without_nan_rows(
        points_of(read_cloud(input, {.allow_empty = true, .context = options.context})), input,
        options, true);
  } else {
    const bool drop = options.nan == NanPolicy::drop;
    detail::TextTable table =
        detail::read_text_table(input, drop ? Allow::any : Allow::finite, options);
    points = drop ? detail::without_nan_rows(std::move(table.rows), input, options, false)
                  : std::move(table.rows);
  }
  if (points.rows() == 0 && !options.allow_empty) {
    input.fail({"no points", {}, "one point a line", "--allow-empty accepts an empty set"});
  }
  return points;
}

Points read_points(const std::filesystem::path& path, const ReadOptions& options) {
  return read_points(Input::open(path, options.context), options);
}

}  // namespace ph
