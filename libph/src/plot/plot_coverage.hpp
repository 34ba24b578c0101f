// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace ph::plot {

/// A position in pixels, with y pointing down.
struct Place {
  double x = 0, y = 0;
};

/// The part of each pixel that an area covers. Areas are added edge by edge. Overlapping areas with
/// the same orientation form a single area.
class Coverage {
 public:
  Coverage(std::size_t width, std::size_t height);

  /// Adds an edge of an area. The edge may be outside the picture. All edges of the area must be
  /// added.
  void add(Place from, Place to);
  /// Adds a polygon, which is closed automatically.
  void add(std::span<const Place> corners);
  /// Adds a polygon, and reverses its orientation if necessary, so that overlapping polygons form a
  /// single area.
  void add_turned(std::span<const Place> corners);

  /// Calls visit(pixel, part) for each pixel of which more than 1/512 is covered, row by row, where
  /// `part` is at most 1. Then forgets the areas.
  template <class Visit>
  void take(Visit&& visit);

 private:
  void add_within_row(std::size_t row, Place from, Place to);
  void add_within_pixel(std::size_t row, Place from, Place to);

  std::size_t width_, height_;
  // The change of the coverage from each pixel to the next pixel on its right, row by row. Each row
  // has one extra column.
  std::vector<float> change_;
  std::size_t first_row_, end_row_;  // range of rows that were touched
};

/// The area of a polygon. It is positive if the polygon is oriented clockwise, with y pointing
/// down.
double signed_area(std::span<const Place> corners);

template <class Visit>
void Coverage::take(Visit&& visit) {
  constexpr float least = 1.0F / 512;
  for (std::size_t row = first_row_; row < end_row_; ++row) {
    float* const change = change_.data() + row * (width_ + 1);
    float sum = 0;
    for (std::size_t x = 0; x < width_; ++x) {
      sum += change[x];
      const float part = std::min(std::abs(sum), 1.0F);
      if (part > least) visit(row * width_ + x, static_cast<double>(part));
    }
    std::fill_n(change, width_ + 1, 0.0F);
  }
  first_row_ = height_;
  end_row_ = 0;
}

}  // namespace ph::plot
