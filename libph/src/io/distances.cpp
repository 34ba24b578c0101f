// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "matrix_entry.hpp"
#include "ph/io/read.hpp"
#include "readers.hpp"
#include "table.hpp"

namespace ph {
namespace {

constexpr double kSymmetric = detail::kRounding;  // matrices computed in float32 are ordinary
constexpr const char* kCorrelations = "--from-correlation reads a correlation matrix";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t triangle(std::size_t n) { return n % 2 == 0 ? n / 2 * (n - 1) : (n - 1) / 2 * n; }

// The n with n (n - 1) / 2 == pairs, if there is one.
std::optional<std::size_t> points_of_pairs(std::size_t pairs) {
  const auto root = std::sqrt(8.0 * static_cast<double>(pairs) + 1.0);
  const auto guess = static_cast<std::size_t>((1.0 + root) / 2.0);
  for (std::size_t n = std::max<std::size_t>(guess, 2) - 1; n <= guess + 1; ++n) {
    if (n > 0 && triangle(n) == pairs) return n;
  }
  return std::nullopt;
}

// The diagonal of a matrix of distances, which is known to be zero only when all of it was read:
// what is small beside the largest entry is rounding.
class Diagonal {
 public:
  void add(double entry) { entries_.push_back(entry); }
  void look_at(double distance) {
    if (distance > largest_ && std::isfinite(distance)) largest_ = distance;
  }
  /// Says that rounding was taken for 0. Calls `fail(point, fault)`, which does not return, at the
  /// first entry that is more than that.
  template <class Fail>
  void finish(const ReadOptions& options, Fail&& fail) const {
    double rounding = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const double entry = entries_[i];
      rounding = std::max(rounding, std::abs(entry));
      if (std::abs(entry) <= kSymmetric * largest_) continue;
      const bool is_one = std::abs(entry - 1) <= kSymmetric;
      fail(i,
           Fault{"non-zero diagonal", fmt::format("{}", entry),
                 largest_ > 0 ? fmt::format("0, or rounding: at most {:.2g}", kSymmetric * largest_)
                              : "0",
                 is_one      ? kCorrelations
                 : entry > 0 ? "--diagonal births takes it for the births of the points"
                             : ""});
    }
    if (rounding > 0)
      detail::note(options, fmt::format("the diagonal is 0 but for rounding, at most {:.2g}: taken "
                                        "as 0",
                                        rounding));
  }

 private:
  std::vector<double> entries_;
  double largest_ = 0;
};

// Reads entries of a text matrix, each checked where it stands.
class Entries {
 public:
  Entries(const TextLines& lines, const ReadOptions& options)
      : lines_(lines),
        options_(options),
        cells_(lines,
               options.nan == NanPolicy::drop
                   ? "names? --columns takes some columns only"
                   : "--nan drop takes an empty cell for NaN; --columns takes some columns") {}

  void start() { cells_.start(); }
  bool more() const { return cells_.more(); }
  std::string_view skip() { return cells_.skip(); }
  const char* place() const { return cells_.place(); }

  double next(bool on_diagonal = false) {
    const char* place = cells_.place();
    const double raw =
        cells_.number(options_.nan == NanPolicy::drop ? Allow::missing : Allow::infinite);
    return detail::checked_distance(raw, on_diagonal, options_,
                                    [&](const Fault& fault) { lines_.fail(place, fault); });
  }

 private:
  const TextLines& lines_;
  const ReadOptions& options_;
  Cells cells_;
};

[[noreturn]] void fail_row(const TextLines& lines, std::size_t row, std::size_t found,
                           std::size_t expected) {
  lines.fail(
      lines.line().data(),
      {fmt::format("row {} of the matrix is too {}", row, found < expected ? "short" : "long"),
       fmt::format("{} cell{}", found, found == 1 ? "" : "s"), fmt::format("{}", expected),
       found < expected && lines.offset() == lines.input().size() ? "is the file truncated?" : ""});
}

DistanceMatrix no_points(const Input& input, const ReadOptions& options) {
  if (!options.allow_empty) {
    input.fail({"no points", {}, "a distance matrix", "--allow-empty accepts an empty set"});
  }
  return DistanceMatrix(0, {});
}

// Skips a header; true if the input has data. A header here is a row of names only.
bool first_row(TextLines& lines, const ReadOptions& options) {
  if (!lines.next()) return false;
  if (header_names(lines.line()).empty()) return true;
  detail::note(options, fmt::format("line {} is a header: skipped", lines.number()));
  return lines.next();
}

// Names the option that asked for a square matrix.
std::string why_square(const ReadOptions& options) {
  const std::string_view option = detail::matrix_option(options);
  const std::string question = "is the file truncated, or a set of points?";
  return option.empty() ? question : fmt::format("{} takes a square matrix: {}", option, question);
}

// Memory for all pairs of n points, once the bytes that are there were found to be enough for
// `cells` cells, of which empty ones take a byte.
std::vector<double> make_triangle(const Input& input, std::size_t n, std::size_t first,
                                  std::optional<std::size_t> cells, const ReadOptions& options) {
  if (!cells || *cells > input.size() + 1) {
    std::size_t rows = 0;
    for (TextLines lines(input); lines.next();) ++rows;
    input.fail({"rows and columns do not fit",
                fmt::format("{} rows, the first of {} cells", rows, first),
                fmt::format("{} rows", n == first ? n : n - 1), why_square(options)});
  }
  input.require_memory(triangle(n) * sizeof(double));
  return std::vector<double>(triangle(n));
}

// One distance from the two entries of a pair; nothing if they differ and may not.
std::optional<double> merged(double upper, double lower, Symmetrise how) {
  switch (how) {
    case Symmetrise::max:
      return std::max(upper, lower);
    case Symmetrise::min:
      return std::min(upper, lower);
    case Symmetrise::lower:
      return lower;
    case Symmetrise::none:
      break;
  }
  const bool same =
      upper == lower || (std::isfinite(upper) && std::isfinite(lower) &&
                         std::abs(upper - lower) <= kSymmetric * std::max(upper, lower));
  return same ? std::optional(lower) : std::nullopt;
}

Fault asymmetric(std::size_t i, std::size_t j, double lower, double upper) {
  return {"asymmetric matrix",
          fmt::format("d({},{}) = {} but d({},{}) = {}", i, j, lower, j, i, upper), "both equal",
          "--symmetrise max, min or lower accepts it"};
}

// All pairs on one line, in the order of the rows of a triangle.
DistanceMatrix from_one_line(const TextLines& lines, std::size_t line, std::vector<double> values,
                             bool lower) {
  const auto points = points_of_pairs(values.size());
  if (!points) {
    lines.input().fail_at(line, 1,
                          {"not a triangle",
                           fmt::format("one line of {} cells", values.size()),
                           "a row a line, or n(n-1)/2 cells",
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

// The rows after the first one, which has one cell, of the lower triangle.
DistanceMatrix read_lower_rows(TextLines& lines, Entries& entries, std::vector<double> values) {
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
  return DistanceMatrix(static_cast<Index>(n), std::move(values));
}

// The rows after the first one of the upper triangle: each goes into a column of the lower one.
DistanceMatrix read_upper_rows(TextLines& lines, Entries& entries, const std::vector<double>& first,
                               const ReadOptions& options) {
  const std::size_t n = first.size() + 1;
  std::vector<double> pairs = make_triangle(lines.input(), n, n - 1, triangle(n), options);
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
                        "the upper triangle has n-1, …, 2, 1 cells a row"});
  }
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs));
}

DistanceMatrix read_triangle(const Input& input, const ReadOptions& options, bool lower) {
  TextLines lines(input);
  if (!first_row(lines, options)) return no_points(input, options);
  Entries entries(lines, options);
  std::vector<double> first;
  if (lower) {  // as many pairs as the lines say, but never more than the bytes allow
    const std::string_view text = input.text();
    const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 2;
    const std::size_t most =
        std::min(triangle(std::min(rows, text.size() + 2)), text.size() / 2 + 1);
    input.require_memory(most * sizeof(double));
    first.reserve(most);
  }
  entries.start();
  while (entries.more()) first.push_back(entries.next());
  const std::size_t first_line = lines.number();
  if (!lines.next()) return from_one_line(lines, first_line, std::move(first), lower);
  if (!lower) return read_upper_rows(lines, entries, first, options);
  if (first.size() != 1) {
    input.fail_at(first_line, 1,
                  {"row 1 of the matrix is too long", fmt::format("{} cells", first.size()), "1",
                   "the lower triangle has 1, 2, 3, … cells a row"});
  }
  return read_lower_rows(lines, entries, std::move(first));
}

// Rows of names in another order than columns make another matrix.
class RowNames {
 public:
  explicit RowNames(const detail::TableLayout& layout) : header_(layout.header) {
    is_known_ = layout.names_rows && layout.header.size() == layout.width;
  }
  void check(const TextLines& lines, std::size_t row, std::string_view cell) {
    if (!is_known_) return;
    const std::string_view name = detail::without_quotes(cell);
    const std::string& column = header_[row + 1];
    if (name == column) return;
    if (std::find(header_.begin() + 1, header_.end(), name) == header_.end()) {
      is_known_ = false;  // rows are named or numbered in a way of their own
      return;
    }
    lines.fail(lines.line().data(), {"rows and columns in another order",
                                     fmt::format("row {} of the name {}", row, printable(name, 40)),
                                     printable(column, 40) + ", as the column",
                                     {}});
  }

 private:
  const std::vector<std::string>& header_;
  bool is_known_ = false;
};

DistanceMatrix read_text_square(const Input& input, const ReadOptions& options) {
  const detail::TableLayout layout = detail::table_layout(input, options);
  layout.tell(options);
  TextLines lines(input);
  if (!layout.start(lines)) return no_points(input, options);
  const std::vector<bool> taken = layout.taken();
  const std::size_t n = layout.columns.size();
  std::vector<double> pairs = make_triangle(input, n, n, checked_product(n, n), options), births;
  Diagonal diagonal;
  const bool has_zeros = !options.from_correlation && !options.births_on_diagonal;
  RowNames names(layout);
  Entries entries(lines, options);
  std::size_t row = 0;
  do {
    if (row == n) {
      lines.fail(lines.line().data(),
                 {"not square", fmt::format("more than {} rows", n),
                  fmt::format("as many as columns, {}", n), why_square(options)});
    }
    entries.start();
    std::size_t k = 0, cell = 0;
    const auto take = [&](auto&& read) {
      const char* place = entries.place();
      const double value = read(k == row);
      if (k == row) {
        if (options.births_on_diagonal) births.push_back(value);
        if (has_zeros) diagonal.add(value);
      } else if (k > row) {
        pairs[triangle(k) + row] = value;
        diagonal.look_at(value);
      } else {
        double& pair = pairs[triangle(row) + k];
        const auto both = merged(pair, value, options.symmetrise);
        if (!both) lines.fail(place, asymmetric(row, k, value, pair));
        pair = *both;
        diagonal.look_at(value);
      }
      ++k;
    };
    for (; entries.more() && cell < layout.width; ++cell) {
      if (taken[cell]) {
        take([&](bool on_diagonal) { return entries.next(on_diagonal); });
      } else {
        const std::string_view skipped = entries.skip();
        if (cell == 0) names.check(lines, row, skipped);
      }
    }
    if (cell + 1 == layout.width && (options.nan == NanPolicy::drop || !taken[cell]) &&
        detail::ends_empty(lines.line())) {
      if (taken[cell]) take([](bool on_diagonal) { return on_diagonal ? 0 : kInfinity; });  // NaN
      ++cell;
    }
    for (; entries.more(); ++cell) entries.skip();
    if (cell != layout.width) fail_row(lines, row, cell, layout.width);
    ++row;
  } while (lines.next());
  if (row != n) {
    input.fail({"not square", fmt::format("{} rows of {} cells", row, n), fmt::format("{} rows", n),
                why_square(options)});
  }
  diagonal.finish(options, [&](std::size_t point, const Fault& fault) {
    TextLines again(input);
    layout.start(again);
    for (std::size_t i = 0; i < point; ++i) again.next();
    Cells cells(again);
    cells.start();
    for (std::size_t i = 0; i < layout.columns[point]; ++i) cells.skip();
    again.fail(cells.place(), fault);
  });
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs), std::move(births));
}

}  // namespace

namespace detail {

Fault fault_of_entry(double raw, bool on_diagonal, const ReadOptions& options) {
  if (std::isnan(raw) && options.nan == NanPolicy::error) {
    return {"not a distance", "NaN", "0 or more", "--nan drop never joins such a pair"};
  }
  if (options.from_correlation) {
    if (on_diagonal && !std::isnan(raw) && !(std::abs(raw - 1) <= kSymmetric)) {
      return {"diagonal of a correlation matrix", fmt::format("{}", raw), "1", {}};
    }
    if (std::abs(raw) > 1 + kSymmetric) {
      return {"not a correlation", fmt::format("{}", raw), "-1 to 1", {}};
    }
  } else if (on_diagonal && options.births_on_diagonal) {
    if (!(raw >= 0 && raw < kInfinity))
      return {"not a birth", fmt::format("{} on the diagonal", raw), "a finite number >= 0", {}};
  } else if (!on_diagonal && raw < 0) {
    return {"negative distance", fmt::format("{}", raw), "0 or more",
            raw >= -1 ? kCorrelations : ""};
  }
  return {};
}

double distance_of_entry(double raw, bool on_diagonal, const ReadOptions& options) {
  if (std::isnan(raw)) return on_diagonal ? 0 : kInfinity;
  return options.from_correlation ? 1 - std::clamp(raw, -1.0, 1.0) : raw;
}

DistanceMatrix square_to_distances(const Image& array, const Input& input,
                                   const ReadOptions& options) {
  if (array.dim() != 2 || array.extents[0] != array.extents[1]) {
    const std::string_view option = matrix_option(options);
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
  const auto entry = [&](std::size_t i, std::size_t j) {
    return detail::checked_distance(array.values[i * n + j], i == j, options, [&](Fault fault) {
      fault.what += fmt::format(" at row {}, column {}", i, j);
      input.fail(fault);
    });
  };
  Diagonal diagonal;
  const bool has_zeros = !options.from_correlation && !options.births_on_diagonal;
  for (std::size_t i = 0; i < n; ++i) {
    const double on_diagonal = entry(i, i);
    if (options.births_on_diagonal) births.push_back(on_diagonal);
    if (has_zeros) diagonal.add(on_diagonal);
    for (std::size_t j = 0; j < i; ++j) {
      const double lower = entry(i, j), upper = entry(j, i);
      const auto both = merged(upper, lower, options.symmetrise);
      if (!both) input.fail(asymmetric(i, j, lower, upper));
      pairs[triangle(i) + j] = *both;
      diagonal.look_at(std::max(lower, upper));
    }
  }
  diagonal.finish(options, [&](std::size_t point, Fault fault) {
    fault.what += fmt::format(" at row {}, column {}", point, point);
    input.fail(fault);
  });
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs), std::move(births));
}

}  // namespace detail

DistanceMatrix read_distances(const Input& input, const ReadOptions& options) {
  if (detail::is_npy(input) || detail::is_npz(input)) {
    detail::refuse_columns(options, "distances, NPY");
    return detail::square_to_distances(detail::read_npy_array(input), input, options);
  }
  if (detail::is_dipha(input)) return detail::read_dipha_distances(input, options);
  return read_text_square(input, options);
}

DistanceMatrix read_lower_distances(const Input& input, const ReadOptions& options) {
  return read_triangle(input, options, true);
}

DistanceMatrix read_upper_distances(const Input& input, const ReadOptions& options) {
  return read_triangle(input, options, false);
}

DistanceMatrix read_binary_distances(const Input& input, const ReadOptions& options) {
  if (input.size() == 0) return no_points(input, options);
  const std::size_t count = input.size() / sizeof(float);
  const auto points = points_of_pairs(count);
  if (input.size() % sizeof(float) != 0 || !points) {
    input.fail({"truncated or not a triangle",
                fmt::format("{} bytes", input.size()),
                "4 n(n-1)/2 bytes: float32, little endian, the lower triangle",
                {}});
  }
  input.require_memory(count * sizeof(double));
  std::vector<double> pairs(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto raw = load<float>(input.bytes().data() + k * sizeof(float), std::endian::little);
    pairs[k] = detail::checked_distance(double{raw}, false, options, [&](const Fault& fault) {
      input.fail_at_byte(k * sizeof(float), fault);
    });
  }
  return DistanceMatrix(static_cast<Index>(*points), std::move(pairs));
}

DistanceMatrix read_distances(const std::filesystem::path& path, const ReadOptions& options) {
  return read_distances(Input::open(path, options.context), options);
}
DistanceMatrix read_lower_distances(const std::filesystem::path& path, const ReadOptions& options) {
  return read_lower_distances(Input::open(path, options.context), options);
}
DistanceMatrix read_upper_distances(const std::filesystem::path& path, const ReadOptions& options) {
  return read_upper_distances(Input::open(path, options.context), options);
}
DistanceMatrix read_binary_distances(const std::filesystem::path& path,
                                     const ReadOptions& options) {
  return read_binary_distances(Input::open(path, options.context), options);
}

}  // namespace ph
