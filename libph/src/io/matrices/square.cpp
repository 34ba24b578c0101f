// SPDX-License-Identifier: MIT
// Recognises square tables of numbers that may be distances or correlations.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ph/barcode.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

// The allowed difference between correlations that should be equal.
constexpr double kLittle = 0.01;

}  // namespace

SquareKind kind_of_square(std::span<const double> block, std::size_t side) {
  double largest = 0;
  for (const double value : block)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const double rounding = kRounding * largest;
  bool positive = true, in_one = true;
  double most_apart = 0;   // the largest difference between the entries of a pair
  std::size_t uneven = 0;  // the number of entries that differ from their mirror image
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double value = block[i * side + j], other = block[j * side + i];
      in_one = in_one && !(std::abs(value) > 1 + kRounding);
      if (i == j || std::isnan(value)) {
        if (i != j && !std::isnan(other)) {
          ++uneven;
          most_apart = kInfinity;
        }
        continue;
      }
      positive = positive && value >= -rounding;
      // mutant: guess-rounding
      if (value == other || std::abs(value - other) <= rounding) continue;
      ++uneven;
      most_apart = std::isnan(other) ? kInfinity : std::max(most_apart, std::abs(value - other));
    }
  }
  const bool symmetric = uneven == 0;
  bool zeros = true, ones = true, known = false;
  for (std::size_t i = 0; i < side; ++i) {
    const double value = block[i * side + i];
    if (std::isnan(value)) continue;
    known = true;
    zeros = zeros && std::abs(value) <= rounding;  // mutant: guess-zeros
    ones = ones && std::abs(value - 1) <= kRounding;
  }
  if (known && zeros) return symmetric && positive ? SquareKind::distances : SquareKind::zeros;
  const bool is_of_ones = known && ones && in_one;  // mutant: guess-ones
  if (symmetric) return is_of_ones ? SquareKind::correlations : SquareKind::symmetric;
  // Any picture with few objects is mostly symmetric, because most of its pairs of entries are
  // zeros.
  if (is_mostly_zero(block, side)) return SquareKind::nothing;
  const bool is_nearly = 10 * uneven <= side * (side - 1);
  if (is_of_ones && (is_nearly || most_apart <= kLittle)) return SquareKind::nearly_correlations;
  return is_nearly ? SquareKind::nearly_symmetric : SquareKind::nothing;
}

bool is_mostly_zero(std::span<const double> block, std::size_t side) {
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j < side; ++j) zeros += i != j && block[i * side + j] == 0 ? 1 : 0;
  return 2 * zeros > side * (side - 1);
}

TableShape shape_of(const Input& input, const TableLayout& layout) {
  const std::size_t n = layout.columns.size(), side = std::min(n, kMostLookedAt);
  std::vector<double> block(side * side, std::numeric_limits<double>::quiet_NaN());
  const std::vector<bool> taken = layout.taken();
  const bool has_names = layout.names_rows && layout.header.size() == layout.width;
  TableShape shape{.same_names = has_names};
  TextLines lines = layout.lines(input);
  Cells cells(lines, {}, layout.separator);
  std::size_t rows = 0;
  for (bool more = layout.start(lines); more && rows <= n; more = lines.next(), ++rows) {
    if (rows >= side) continue;
    std::size_t length = 0, column = 0;
    for (cells.start(); cells.more() && length < layout.width; ++length) {
      const std::string_view cell = cells.skip();
      if (length == 0)
        shape.same_names = shape.same_names && without_quotes(cell) == layout.header[rows + 1];
      if (taken[length] && column < side) {
        double& entry = block[rows * side + column++];
        entry = number_in(cell).value_or(entry);
      }
    }
    const bool is_short =
        length != layout.width && !(length + 1 == layout.width && ends_empty(lines.line()));
    if (is_short || cells.more()) return {};
  }
  shape.rows = rows;
  if (n >= 2 && rows == n) shape.square = kind_of_square(block, side);
  return shape;
}

}  // namespace ph::detail
