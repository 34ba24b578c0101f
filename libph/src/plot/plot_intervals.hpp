// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

#include "libph/src/plot/plot_canvas.hpp"

// This code is shared by pictures of barcodes and merge trees, which draw classes as lines over the
// filtration value. The longest classes are drawn one by one, and the others are drawn as a
// density.
namespace ph::plot {

inline constexpr double kFirstValue = 30, kLastValue = 242;  // start and end of the axis
inline constexpr double kTriangle = 4.5;                     // room for a triangle after the axis
inline constexpr std::size_t kRows = 96;      // about the largest number of lines in one picture
inline constexpr double kDensityHeight = 16;  // height of a density with its caption

/// Positions in a list of classes. The first list has the positions of the longest classes,
/// ascending. The second list has the positions of all other classes.
struct Longest {
  std::vector<std::size_t> crisp, rest;
};
/// @param most the number of classes that are drawn one by one. If at most `handful` classes would
/// remain, all classes are drawn in this way.
/// @param length returns the length of the class at a position.
template <class Length>
Longest longest_of(std::size_t count, std::size_t most, Length&& length) {
  constexpr std::size_t handful = 8;  // this many lines take less space than a density
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

/// The distance between the lines if there are `rows` of them.
double pitch_of(std::size_t rows);

/// Lines of one colour, one for each class. A triangle ends the line of a class that never dies.
class Lines {
 public:
  Lines(const Axis& axis, double pitch);
  void add(double birth, double death, double y);
  /// @pre these lines have not been drawn yet.
  void draw(Canvas& canvas, Colour colour);
  /// The start of a line.
  double start(double birth) const;

 private:
  const Axis& axis_;
  double pitch_, half_;  // half the size of a triangle
  Outline lines_, triangles_;
};

/// The number of classes alive at each value, without the classes drawn as lines. It is shown as
/// the darkness of a strip.
class Density {
 public:
  explicit Density(const Axis& axis);
  void add(double birth, double death);
  /// Draws the strip with its caption. Together they have the height kDensityHeight.
  void draw(Canvas& canvas, double top, Colour colour) const;

 private:
  std::size_t column_of(double value) const;

  const Axis& axis_;
  std::size_t all_ = 0;
  std::vector<double> change_;  // change of the number of classes in each column
};

/// Explains the triangles, to the right of the axis's name.
void explain_triangles(Canvas& canvas, double bottom);

}  // namespace ph::plot
