// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "libph/src/vectors/grid_cells.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/error.hpp"

namespace ph {
namespace vectors {
namespace {

struct Range {
  double lo = kInfinity, hi = -kInfinity;
  void take(double x) {
    if (!std::isfinite(x)) return;
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
};

/// Returns a range that is longer than 0. The result is the given range if possible. If the given
/// range is a single number, the result is an interval around that number. Its length is `width`,
/// or more if the number is large. If the given range is empty, the result is [0, width].
Range widened(const Range& range, double width) {
  if (range.lo > range.hi) return {0, width};
  if (range.lo < range.hi) return range;
  // The width is large enough not to be lost to rounding when it is added to the number.
  const double half = std::max(width / 2, std::ldexp(std::abs(range.lo), -40));
  return {range.lo - half, range.hi + half};
}

}  // namespace

void check(const Grid& grid, std::string_view function) {
  const bool is_finite = std::abs(grid.lo) <= kLargest && std::abs(grid.hi) <= kLargest;
  if (grid.points >= 1 && is_finite &&
      (grid.lo < grid.hi || (grid.points == 1 && grid.lo == grid.hi)))
    return;
  throw Error(ErrorKind::usage,
              fmt::format("{}: grid: found {} points from {} to {}, expected at least 1 point and "
                          "ascending ends of at most {} in absolute value",
                          mark_place(function), grid.points, grid.lo, grid.hi, kLargest));
}

GridCells::GridCells(const Grid& grid, std::string_view function) {
  check(grid, function);
  values_ = grid.values();
  const double width = values_.back() - values_.front();
  per_step_ = width > 0 ? static_cast<double>(size() - 1) / width : 0;
  if (!(per_step_ < kInfinity)) per_step_ = 0;  // places are then found by search
}

}  // namespace vectors

std::vector<double> Grid::values() const {
  std::vector<double> values(points);
  const double step = points > 1 ? (hi - lo) / static_cast<double>(points - 1) : 0;
  for (std::size_t i = 0; i < points; ++i) values[i] = static_cast<double>(i) * step + lo;
  if (points > 1) values.back() = hi;  // mutant: grid-last
  return values;
}

Grid fit_grid(std::span<const std::span<const Bar>> diagrams, std::size_t points) {
  if (points < 1) throw Error(ErrorKind::usage, "fit_grid: found 0 points, expected at least 1");
  vectors::Range range;
  for (const auto& bars : diagrams)
    for (const Bar& bar : bars) {
      vectors::check_bar(bar, "fit_grid");
      if (bar.birth == bar.death) continue;  // a bar of length 0 contributes to no vector
      range.take(bar.birth);
      range.take(bar.death);
    }
  range = vectors::widened(range, 1);
  return {range.lo, range.hi, points};
}

ImageFrame fit_image_frame(std::span<const std::span<const Bar>> diagrams, std::size_t births,
                           std::size_t lengths) {
  if (births < 1 || lengths < 1)
    throw Error(ErrorKind::usage, fmt::format("fit_image_frame: found {} × {} pixels, expected at "
                                              "least 1 × 1",
                                              lengths, births));
  vectors::Range range;
  double longest = 0;
  for (const auto& bars : diagrams)
    for (const Bar& bar : vectors::checked_bars(bars, vectors::Ends::finite, "fit_image_frame")) {
      range.take(bar.birth);
      longest = std::max(longest, bar.persistence());
    }
  if (longest == 0) longest = 1;
  range = vectors::widened(range, longest);
  return {{range.lo, range.hi, births}, {0, longest, lengths}};
}

}  // namespace ph
