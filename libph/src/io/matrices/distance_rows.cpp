// SPDX-License-Identifier: MIT
#include "libph/src/io/matrices/distance_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ph/detail/io/table.hpp"

namespace ph::detail {

DistanceMatrix no_points(const Input& input, const ReadOptions& options) {
  if (!options.allow_empty) {
    input.fail({"no points",
                {},
                "a distance matrix",
                mark(Setting::allow_empty) + " accepts an empty set"});
  }
  return DistanceMatrix(0, {});
}

std::string why_square(const ReadOptions& options) {
  const std::string option = matrix_option(options);
  const std::string question = "is the file truncated, or a set of points?";
  return option.empty() ? question : fmt::format("{} takes a square matrix: {}", option, question);
}

std::vector<double> make_triangle(const Input& input, std::size_t n, std::size_t first,
                                  std::optional<std::size_t> cells, const ReadOptions& options) {
  if (!cells || *cells > input.size() + 1) {
    std::size_t rows = 0;
    for (TextLines lines(input); lines.next();) ++rows;
    input.fail({"rows and columns do not match",
                fmt::format("{} rows, the first of {} cells", rows, first),
                fmt::format("{} rows", n == first ? n : n - 1), why_square(options)});
  }
  input.require_memory(triangle(n) * sizeof(double));
  return std::vector<double>(triangle(n));
}

void fail_row(const TextLines& lines, std::size_t row, std::size_t found, std::size_t expected,
              std::string_view hint) {
  lines.fail(
      lines.line().data(),
      {fmt::format("row {} of the matrix is too {}", row, found < expected ? "short" : "long"),
       fmt::format("{} cell{}", found, found == 1 ? "" : "s"), fmt::format("{}", expected),
       !hint.empty()                                                ? std::string(hint)
       : found < expected && lines.offset() == lines.input().size() ? "is the file truncated?"
                                                                    : ""});
}

TextEntries::TextEntries(const TextLines& lines, const ReadOptions& options, char separator)
    : lines_(lines),
      options_(options),
      cells_(lines, cell_hints(options), separator),
      entries_(options) {}

EntryPlace TextEntries::place(std::size_t row, std::size_t column) const {
  return {row, column, static_cast<std::size_t>(cells_.place() - lines_.input().text().data())};
}

double TextEntries::distance(double raw, const EntryPlace& place) {
  return entries_.distance(raw, place, [&](const Fault& fault) {
    lines_.fail(lines_.input().text().data() + place.byte, fault);
  });
}

double TextEntries::next(const EntryPlace& place) {
  return distance(cells_.number(options_.nan == NanPolicy::drop ? Allow::missing : Allow::infinite),
                  place);
}

double TextEntries::missing(const EntryPlace& place) {
  return distance(std::numeric_limits<double>::quiet_NaN(), place);
}

void TextEntries::finish() const {
  entries_.finish([&](const EntryPlace& place, const Fault& fault) {
    fail_in_text(lines_.input(), place.byte, fault);
  });
}

}  // namespace ph::detail
