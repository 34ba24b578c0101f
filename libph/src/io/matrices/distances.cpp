// SPDX-License-Identifier: MIT
// Reads square matrices of distances, as text and as arrays.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/matrices/distance_rows.hpp"
#include "ph/detail/io/table.hpp"

namespace ph {
namespace {

using detail::EntryPlace;
using detail::triangle;

// Checks that the rows are named in the same order as the columns. Otherwise the entries would
// belong to other pairs.
class RowNames {
 public:
  explicit RowNames(const detail::TableLayout& layout) : header_(layout.header) {
    // mutant: table-name-order
    is_known_ = layout.names_rows && layout.header.size() == layout.width;
  }
  void check(const TextLines& lines, std::size_t row, std::string_view cell) {
    if (!is_known_) return;
    const std::string_view name = detail::without_quotes(cell);
    const std::string& column = header_[row + 1];
    if (name == column) return;
    if (std::find(header_.begin() + 1, header_.end(), name) == header_.end()) {
      is_known_ = false;  // the names or numbers of rows are unrelated to columns
      return;
    }
    lines.fail(lines.line().data(),
               {"rows and columns in different orders",
                fmt::format("row {} with the name {}", row, printable(name, 40)),
                fmt::format("{}, the name of column {}", printable(column, 40), row),
                {}});
  }

 private:
  const std::vector<std::string>& header_;
  bool is_known_ = false;
};

DistanceMatrix read_text_square(const Input& input, const ReadOptions& options) {
  const detail::TableLayout layout = detail::table_layout(input, options);
  layout.tell(options);
  TextLines lines = layout.lines(input);
  if (!layout.start(lines)) return detail::no_points(input, options);
  const std::vector<bool> taken = layout.taken();
  const std::size_t n = layout.columns.size();
  std::vector<double> pairs = detail::make_triangle(input, n, n, checked_product(n, n), options);
  std::vector<double> births;
  RowNames names(layout);
  detail::TextEntries entries(lines, options, layout.separator);
  std::size_t row = 0;
  do {
    if (row == n) {
      lines.fail(lines.line().data(),
                 {"not square", fmt::format("more than {} rows", n),
                  fmt::format("{}, as many as there are columns", n), detail::why_square(options)});
    }
    entries.start();
    std::size_t k = 0, cell = 0;
    const auto take = [&](double value, const EntryPlace& place) {
      if (k == row) {
        if (options.diagonal == Diagonal::births) births.push_back(value);
      } else if (k > row) {
        pairs[triangle(k) + row] = value;
      } else {
        double& pair = pairs[triangle(row) + k];
        pair = entries.merged(pair, value, place);
      }
      ++k;
    };
    for (; entries.more() && cell < layout.width; ++cell) {
      const EntryPlace place = entries.place(row, k);
      if (taken[cell]) {
        take(entries.next(place), place);
      } else {
        const std::string_view skipped = entries.skip();
        if (cell == 0) names.check(lines, row, skipped);
      }
    }
    if (cell + 1 == layout.width && (options.nan == NanPolicy::drop || !taken[cell]) &&
        detail::ends_empty(lines.line())) {
      const EntryPlace place = entries.place(row, k);
      if (taken[cell]) take(entries.missing(place), place);
      ++cell;
    }
    for (; entries.more(); ++cell) entries.skip();
    if (cell + 1 == layout.width && detail::ends_empty(lines.line()))
      detail::fail_row(lines, row, cell, layout.width,
                       mark(Setting::nan, "drop") + " accepts an empty last cell");
    if (cell != layout.width) detail::fail_row(lines, row, cell, layout.width);
    ++row;
  } while (lines.next());
  if (row != n) {
    input.fail({"not square", fmt::format("{} rows of {} cells", row, n), fmt::format("{} rows", n),
                detail::why_square(options)});
  }
  if (layout.said && *layout.said != n)
    input.fail_at(layout.said_line, 1,
                  {"number of rows",
                   fmt::format("{}", *layout.said),
                   fmt::format("{}, the rows of the matrix", n),
                   {}});
  entries.finish();
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs), std::move(births));
}

}  // namespace

namespace detail {

DistanceMatrix square_to_distances(const Image& array, const Input& input,
                                   const ReadOptions& options) {
  if (array.dim() != 2 || array.extents[0] != array.extents[1]) {
    const std::string option = matrix_option(options);
    input.fail({"not a square matrix",
                fmt::format("shape ({})", fmt::join(array.extents, ", ")),
                option.empty() ? "as many columns as rows"
                               : fmt::format("as many columns as rows, for {}", option),
                {}});
  }
  const auto n = static_cast<std::size_t>(array.extents[0]);
  if (n == 0) return no_points(input, options);
  input.require_memory(triangle(n) * sizeof(double));
  std::vector<double> pairs(triangle(n)), births;
  MatrixEntries entries(options);
  const auto fail = [&](const EntryPlace& place, Fault fault) {
    fault.what += fmt::format(" at row {}, column {}", place.row, place.column);
    input.fail(fault);
  };
  const auto entry = [&](std::size_t i, std::size_t j) {
    const EntryPlace place{i, j};
    return entries.distance(array.values[i * n + j], place,
                            [&](const Fault& fault) { fail(place, fault); });
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double on_diagonal = entry(i, i);
    if (options.diagonal == Diagonal::births) births.push_back(on_diagonal);
    for (std::size_t j = 0; j < i; ++j) {
      const double lower = entry(i, j), upper = entry(j, i);
      pairs[triangle(i) + j] = entries.merged(upper, lower, {i, j});
    }
  }
  entries.finish(fail);
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs), std::move(births));
}

}  // namespace detail

DistanceMatrix read_distances(const Input& input, const ReadOptions& options) {
  if (detail::is_npy(input) || detail::is_npz(input)) {
    detail::refuse_columns(options, "distances, NPY");
    return detail::square_to_distances(detail::read_npy_array(input), input, options);
  }
  if (detail::is_dipha(input)) {
    detail::refuse_columns(options, "distances, DIPHA");
    return detail::read_dipha_distances(input, options);
  }
  return read_text_square(input, options);
}

DistanceMatrix read_distances(const std::filesystem::path& path, const ReadOptions& options) {
  return read_distances(
      Input::open(path, options.context, Input::Excess::refused, detail::start_check()), options);
}

}  // namespace ph
