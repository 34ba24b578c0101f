// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

#include "plot/plot_canvas.hpp"

// What the pictures of barcodes and of merge trees have in common: classes as lines over the
// filtration value, the longest crisp, the others as a density.
namespace ph::plot {

inline constexpr double kFirstValue = 30, kLastValue = 242;  // where the axis begins and ends
inline constexpr double kTriangle = 4.5;                     // room behind it
inline constexpr std::size_t kRows = 96;                     // lines in one picture
inline constexpr double kDensityHeight = 16;                 // with its caption

/// Places in a list, ascending: of the longest classes, and of all others.
struct Longest {
  std::vector<std::size_t> crisp, rest;
};
/// @param most so many are crisp; all if the others are but a handful. @param length of a place.
template <class Length>
Longest longest_of(std::size_t count, std::size_t most, Length&& length) {
  constexpr std::size_t handful = 8;  // takes less room than a density
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t crisp = count <= most + handful ? count : most;
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(crisp);
  const auto longer = [&](std::size_t a, std::size_t b) {
    const double x = length(a), y = length(b);
    return x != y ? x > y : a < b;
  };
  if (crisp < count) std::nth_element(order.begin(), middle, order.end(), longer);
  Longest longest{{order.begin(), middle}, {middle, order.end()}};
  std::ranges::sort(longest.crisp);
  return longest;
}

/// The distance of lines.
double pitch_of(std::size_t rows);

/// Lines of one colour, one a class; a triangle ends one that never dies.
class Lines {
 public:
  Lines(const Axis& axis, double pitch);
  void add(double birth, double death, double y);
  /// @pre it has not been drawn yet.
  void draw(Canvas& canvas, Colour colour);
  /// Where a line begins.
  double start(double birth) const;

 private:
  const Axis& axis_;
  double pitch_, half_;  // of a triangle
  Outline lines_, triangles_;
};

/// How many of the other classes live at each value, as the darkness of a strip.
class Density {
 public:
  explicit Density(const Axis& axis);
  void add(double birth, double death);
  /// With its caption, kDensityHeight high.
  void draw(Canvas& canvas, double top, Colour colour) const;

 private:
  std::size_t column_of(double value) const;

  const Axis& axis_;
  std::size_t all_ = 0;
  std::vector<double> change_;  // by column
};

/// What a triangle means, at the right, beside the name of the axis.
void explain_triangles(Canvas& canvas, double bottom);

}  // namespace ph::plot
