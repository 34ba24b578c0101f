// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ph/io/read.hpp"
#include "readers.hpp"

namespace ph {
namespace {

constexpr double kSymmetric = 1e-6;  // relative; matrices computed in float32 are ordinary
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

// What is wrong with a number of the input off or on the diagonal; `what` is empty if nothing is.
Fault fault_of(double raw, bool on_diagonal, const ReadOptions& options) {
  constexpr const char* hint = "--from-correlation reads a correlation matrix";
  if (std::isnan(raw) && options.nan == NanPolicy::error) {
    return {"not a distance", "NaN", "0 or more", "--nan drop never joins such a pair"};
  }
  if (options.from_correlation) {
    if (on_diagonal && !(std::abs(raw - 1) <= kSymmetric)) {
      return {"diagonal of a correlation matrix", fmt::format("{}", raw), "1", {}};
    }
    if (std::abs(raw) > 1 + kSymmetric) {
      return {"not a correlation", fmt::format("{}", raw), "-1 to 1", {}};
    }
  } else if (on_diagonal && options.births_on_diagonal) {
    if (!(raw >= 0 && raw < kInfinity))
      return {"not a birth", fmt::format("{} on the diagonal", raw), "a finite number >= 0", {}};
  } else if (on_diagonal && raw != 0 && !std::isnan(raw)) {
    return {"non-zero diagonal", fmt::format("{}", raw), "0",
            raw == 1  ? hint
            : raw > 0 ? "--diagonal births takes it for the births of the points"
                      : ""};
  } else if (raw < 0) {
    return {"negative distance", fmt::format("{}", raw), "0 or more", raw >= -1 ? hint : ""};
  }
  return {};
}

// The distance that a faultless number means.
double distance_of(double raw, const ReadOptions& options) {
  if (std::isnan(raw)) return kInfinity;
  return options.from_correlation ? 1 - std::clamp(raw, -1.0, 1.0) : raw;
}

// The distance that a number of the input means. Calls `fail(fault)`, which does not return, if it
// means none.
template <class Fail>
double checked_distance(double raw, bool on_diagonal, const ReadOptions& options, Fail&& fail) {
  if (raw >= 0 && !options.from_correlation && !on_diagonal) return raw;  // as a rule
  if (Fault fault = fault_of(raw, on_diagonal, options); !fault.what.empty())
    fail(std::move(fault));
  return distance_of(raw, options);
}

// Reads entries of a text matrix, each checked where it stands.
class Entries {
 public:
  Entries(const TextLines& lines, const ReadOptions& options)
      : lines_(lines), options_(options), cells_(lines) {}

  void start() { cells_.start(); }
  bool more() const { return cells_.more(); }
  void skip() { cells_.word(); }
  const char* place() const { return cells_.place(); }

  double next(bool on_diagonal = false) {
    const char* place = cells_.place();
    const double raw =
        cells_.number(options_.nan == NanPolicy::drop ? Allow::any : Allow::infinite);
    return checked_distance(raw, on_diagonal, options_,
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

// Memory for all pairs of n points, once the bytes that are there were found to be enough for
// `cells` cells.
std::vector<double> make_triangle(const Input& input, std::size_t n, std::size_t first,
                                  std::optional<std::size_t> cells) {
  if (!cells || *cells > input.size() / 2 + 1) {
    std::size_t rows = 0;
    for (TextLines lines(input); lines.next();) ++rows;
    input.fail({"rows and columns do not fit",
                fmt::format("{} rows, the first of {} cells", rows, first),
                fmt::format("{} rows", n == first ? n : n - 1),
                "is the file truncated, or a set of points?"});
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
DistanceMatrix read_upper_rows(TextLines& lines, Entries& entries,
                               const std::vector<double>& first) {
  const std::size_t n = first.size() + 1;
  std::vector<double> pairs = make_triangle(lines.input(), n, n - 1, triangle(n));
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
  if (!lower) return read_upper_rows(lines, entries, first);
  if (first.size() != 1) {
    input.fail_at(first_line, 1,
                  {"row 1 of the matrix is too long", fmt::format("{} cells", first.size()), "1",
                   "the lower triangle has 1, 2, 3, … cells a row"});
  }
  return read_lower_rows(lines, entries, std::move(first));
}

DistanceMatrix read_text_square(const Input& input, const ReadOptions& options) {
  TextLines lines(input);
  if (!first_row(lines, options)) return no_points(input, options);
  std::size_t n = 0;
  Cells count(lines);
  for (count.start(); count.more(); ++n) count.word();
  std::vector<double> pairs = make_triangle(input, n, n, checked_product(n, n)), births;
  Entries entries(lines, options);
  std::size_t row = 0;
  do {
    if (row == n) {
      lines.fail(lines.line().data(), {"not square",
                                       fmt::format("more than {} rows", n),
                                       fmt::format("as many as columns, {}", n),
                                       {}});
    }
    entries.start();
    std::size_t k = 0;
    for (; entries.more() && k < n; ++k) {
      if (k == row) {
        const double birth = entries.next(true);
        if (options.births_on_diagonal) births.push_back(birth);
      } else if (k > row) {
        pairs[triangle(k) + row] = entries.next();
      } else {
        const char* place = entries.place();
        double& pair = pairs[triangle(row) + k];
        const double value = entries.next();
        const auto both = merged(pair, value, options.symmetrise);
        if (!both) lines.fail(place, asymmetric(row, k, value, pair));
        pair = *both;
      }
    }
    for (; entries.more(); ++k) entries.skip();
    if (k != n) fail_row(lines, row, k, n);
    ++row;
  } while (lines.next());
  if (row != n) {
    input.fail({"not square", fmt::format("{} rows of {} cells", row, n), fmt::format("{} rows", n),
                "is the file truncated, or a set of points?"});
  }
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs), std::move(births));
}

}  // namespace

namespace detail {

DistanceMatrix square_to_distances(const Image& array, const Input& input,
                                   const ReadOptions& options) {
  if (array.dim() != 2 || array.extents[0] != array.extents[1]) {
    input.fail({"not a square matrix",
                fmt::format("shape ({})", fmt::join(array.extents, ", ")),
                "as many columns as rows",
                {}});
  }
  const auto n = static_cast<std::size_t>(array.extents[0]);
  if (n == 0) return no_points(input, options);
  input.require_memory(triangle(n) * sizeof(double));
  std::vector<double> pairs(triangle(n)), births;
  const auto entry = [&](std::size_t i, std::size_t j) {
    return checked_distance(array.values[i * n + j], i == j, options, [&](Fault fault) {
      fault.what += fmt::format(" at row {}, column {}", i, j);
      input.fail(fault);
    });
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double birth = entry(i, i);
    if (options.births_on_diagonal) births.push_back(birth);
    for (std::size_t j = 0; j < i; ++j) {
      const double lower = entry(i, j), upper = entry(j, i);
      const auto both = merged(upper, lower, options.symmetrise);
      if (!both) input.fail(asymmetric(i, j, lower, upper));
      pairs[triangle(i) + j] = *both;
    }
  }
  return DistanceMatrix(static_cast<Index>(n), std::move(pairs), std::move(births));
}

}  // namespace detail

DistanceMatrix read_distances(const Input& input, const ReadOptions& options) {
  if (detail::is_npy(input) || detail::is_npz(input))
    return detail::square_to_distances(detail::read_npy_array(input), input, options);
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
    pairs[k] = checked_distance(double{raw}, false, options, [&](const Fault& fault) {
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
