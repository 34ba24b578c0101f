// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libph/src/io/points/npy_header.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/cloud.hpp"

namespace ph {

namespace {

// Reads the numbers of a table, without an index column.
detail::TextTable table_of_points(const Input& input, const ReadOptions& options) {
  ReadOptions as_points = options;
  as_points.array = ArrayMeaning::points;
  const detail::TableLayout layout = detail::table_layout(input, as_points);
  detail::TextTable table = detail::read_text_table(
      input, options.nan == NanPolicy::drop ? Allow::missing : Allow::finite, options, false,
      &layout);
  detail::tell_of_counts(input, layout, table.rows, as_points);
  detail::tell_of_columns(layout, table.rows, options);
  return table;
}

// The columns of an array that the options select.
Points chosen_of(Points points, const Input& input, const ReadOptions& options) {
  if (options.columns.empty()) return points;
  const auto columns =
      detail::chosen_columns(options.columns, {}, static_cast<std::size_t>(points.cols()), input);
  Points chosen(points.rows(), static_cast<Index>(columns.size()));
  for (Index i = 0; i < points.rows(); ++i)
    for (std::size_t k = 0; k < columns.size(); ++k)
      chosen(i, static_cast<Index>(k)) = points(i, static_cast<Index>(columns[k]));
  return chosen;
}

}  // namespace

namespace detail {

TextTable read_text_table(const Input& input, Allow allow, const ReadOptions& options, bool counted,
                          const TableLayout* layout) {
  TextTable table;
  TextLines lines = layout != nullptr ? layout->lines(input) : TextLines(input);
  // Programs that read clouds do not have the options that the hints name.
  Cells cells(lines, layout != nullptr && allow != Allow::any ? cell_hints(options) : CellHints(),
              layout != nullptr ? layout->separator : ' ');
  bool more = layout != nullptr ? layout->start(lines) : lines.next();
  std::size_t said = 0;
  if (counted) {
    if (!more) input.fail({"no number of points", "nothing", "it on the first line", {}});
    cells.start();
    const auto most = static_cast<std::int64_t>(input.size());  // a point takes more than one byte
    said = static_cast<std::size_t>(cells.integer(0, most, "number of points"));
    cells.expect_end("the number of points alone");
    more = lines.next();
  } else if (layout != nullptr) {
    table.header = layout->header;
    layout->tell(options);
    said = layout->said.value_or(0);
  } else if (more) {
    table.header = header_names(lines.line());
    if (!table.header.empty()) {
      note(options, fmt::format("line {} is a header: skipped", lines.number()));
      more = lines.next();
    }
  }
  const auto check_count = [&](std::size_t count) {
    if (count == said || !(counted || (layout != nullptr && layout->said))) return;
    input.fail({count < said ? "truncated" : "trailing data",
                fmt::format("{} points", count),
                fmt::format("{}, as {} says", said,
                            counted ? "the first line" : fmt::format("line {}", layout->said_line)),
                {}});
  };
  if (!more) {
    check_count(0);
    return table;
  }

  const std::size_t first_line = lines.number();
  const std::size_t width = layout != nullptr ? layout->width : count_cells(lines);
  const std::vector<bool> taken =
      layout != nullptr ? layout->taken() : std::vector<bool>(width, true);
  const auto columns = static_cast<std::size_t>(std::ranges::count(taken, true));

  // There are at most as many rows as lines. A cell may be empty, but it takes one byte with its
  // separator or the line end. A row therefore takes at least one byte per cell. Whatever the file
  // contains, the table takes at most eight times the size of the file, plus two rows.
  const std::string_view rest = input.text().substr(lines.offset());
  const std::size_t by_lines =
      static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 2;
  const std::size_t most = std::min(by_lines, rest.size() / width + 2);  // mutant: table-row-bytes
  input.require_memory(most * columns * sizeof(double));
  table.rows = Points(static_cast<Index>(most), static_cast<Index>(columns));
  double* value = table.rows.data();
  std::size_t count = 0;
  do {
    cells.start();
    std::size_t k = 0;
    for (; k < width && cells.more(); ++k) {
      if (taken[k]) {
        *value++ = cells.number(allow);
      } else {
        cells.skip();
      }
    }
    if (k + 1 == width && (allow == Allow::missing || !taken[k]) && ends_empty(lines.line())) {
      if (taken[k]) *value++ = std::numeric_limits<double>::quiet_NaN();
      ++k;
    }
    if (k != width || cells.more()) {
      for (; cells.more(); ++k) cells.skip();
      const bool is_last_missing = layout != nullptr && allow != Allow::any &&
                                   options.nan == NanPolicy::error && k + 1 == width &&
                                   ends_empty(lines.line());
      lines.fail(
          lines.line().data(),
          {"ragged row", fmt::format("{} cell{}", k, k == 1 ? "" : "s"),
           lines.number() != first_line ? fmt::format("{}, as in line {}", width, first_line)
           : table.header.empty()       ? fmt::format("{}, as in the next line", width)
                                  : fmt::format("{}, the number of names in the header", width),
           k < width && lines.offset() == input.size()
               ? is_last_missing
                     ? fmt::format("is the file truncated? if not, {} accepts the empty cell",
                                   mark(Setting::nan, "drop"))
                     : "is the file truncated?"
           : is_last_missing ? mark(Setting::nan, "drop") + " accepts an empty last cell"
           : options.array == ArrayMeaning::image ? "an image has rows of one length"
                                                  : ""});
    }
    ++count;
  } while (lines.next());
  check_count(count);
  table.rows.keep_rows(static_cast<Index>(count));
  const bool names_rows = layout != nullptr && layout->names_rows;
  if (!table.header.empty() && table.header.size() != width && width > 1 &&
      table.header.size() > 1 && !names_rows) {
    note(options,
         fmt::format("the header has {} names for {} columns", table.header.size(), width));
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
                    mark(Setting::nan, "drop") + " leaves such points out"});
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
    note(options, fmt::format("{} of {} points {} a NaN coordinate: left out", points.rows() - kept,
                              points.rows(), points.rows() - kept == 1 ? "has" : "have"));
    points.keep_rows(kept);
  }
  return points;
}

Points points_of_array(const Image& array, const Input& input, const ReadOptions& options) {
  // The stored array and the points exist at the same time, and the array is not counted in any
  // budget.
  input.require_memory(array.values.bytes() + array.values.size() * sizeof(double));
  Points points(array.extents[0], array.extents[1]);
  with_voxels(array.values.type(), array.values.data(), [&](const auto* numbers) {
    // The number of values between two polls of the stop token.
    constexpr std::size_t block = 1 << 16;
    for (std::size_t k = 0; k < array.values.size(); k += block) {
      input.poll(input.size());
      const std::size_t count = std::min(block, array.values.size() - k);
      std::copy_n(numbers + k, count, points.data() + k);
    }
  });
  tell_of_whole_columns(points, options);
  return without_nan_rows(chosen_of(std::move(points), input, options), input, options, false);
}

}  // namespace detail

Points read_points(const Input& input, const ReadOptions& options) {
  Points points;
  if (detail::is_npz(input)) {
    const Input array = detail::read_npz_member(input);
    detail::read_npy_header(array);  // anything else is refused
    return read_points(array, options);
  }
  if (detail::is_npy(input) && detail::is_npy_of_records(input)) {
    points = detail::points_of_records(input, options);
  } else if (detail::is_npy(input)) {
    Image array = detail::read_npy_array(input);
    // An organised cloud has a row of points for each row of a picture.
    if (array.dim() == 3 && array.extents[2] == 3) {
      detail::note(options, fmt::format("an array of {} x {} points with three coordinates each",
                                        array.extents[0], array.extents[1]));
      array.extents = {array.extents[0] * array.extents[1], 3};
    }
    if (array.dim() != 2) {
      input.fail(
          {"not a set of points",
           fmt::format("an array of {} dimension{}", array.dim(), array.dim() == 1 ? "" : "s"),
           "2 dimensions, with one point per row, or a shape (rows, columns, 3)",
           array.dim() == 1 ? "a[:, None] has one number per row" : ""});
    }
    if (array.values.empty() && array.extents[0] > 0) {
      input.fail({"points without coordinates",
                  fmt::format("shape ({}, 0)", array.extents[0]),
                  "at least one column",
                  {}});
    }
    points = detail::points_of_array(array, input, options);
  } else if (detail::is_pcd(input) || detail::is_ply(input)) {
    detail::refuse_columns(options, detail::is_pcd(input) ? "PCD" : "PLY");
    points = detail::without_nan_rows(
        points_of(read_cloud(input, {.allow_empty = true, .context = options.context})), input,
        options, true);
  } else {
    points = table_of_points(input, options).rows;
    if (options.nan == NanPolicy::drop)
      points = detail::without_nan_rows(std::move(points), input, options, false);
  }
  if (points.rows() == 0 && !options.allow_empty) {
    input.fail({"no points",
                {},
                "one point per line",
                mark(Setting::allow_empty) + " accepts an empty set"});
  }
  return points;
}

namespace detail {

Image read_grid(const Input& input, const ReadOptions& options) {
  ReadOptions as_image = options;
  as_image.array = ArrayMeaning::image;
  const TableLayout layout = table_layout(input, as_image);
  const Allow allow = options.nan == NanPolicy::drop ? Allow::missing : Allow::infinite;
  Points rows = read_text_table(input, allow, options, false, &layout).rows;
  tell_of_counts(input, layout, rows, as_image);
  Image image;
  if (rows.rows() > 0) image.extents = {rows.rows(), rows.cols()};
  if (rows.rows() == 1 || rows.cols() == 1) image.extents = {rows.size()};
  if (rows.size() == 0) image.extents = {0};
  input.require_memory(static_cast<std::size_t>(rows.size()) * sizeof(double));
  image.values = std::vector<double>(rows.data(), rows.data() + rows.size());
  return without_nan_pixels(std::move(image), input, options);
}

}  // namespace detail

Points read_points(const std::filesystem::path& path, const ReadOptions& options) {
  return read_points(
      Input::open(path, options.context, Input::Excess::refused, detail::start_check()), options);
}

}  // namespace ph
