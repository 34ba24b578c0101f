// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "libph/src/alpha/sites/power_of_two.hpp"
#include "ph/points.hpp"

namespace ph::alpha {

/// A box whose opposite faces are glued together along some axes; these axes are called *closed*.
/// Along each axis, the box starts at 0.
struct Box {
  std::array<double, 3> period{};  ///< indexed by axis; 0 if the axis is open
  /// An upper bound for the diagonal of the bounding box of the points in the box. No empty sphere
  /// extends beyond the box by more than twice this size.
  double size = 0;

  bool is_closed(std::size_t axis) const { return period[axis] > 0; }
  /// The box with all lengths multiplied by 2^exponent.
  Box times_power_of_two(int exponent) const {
    Box box = *this;
    for (double& length : box.period) length = alpha::times_power_of_two(length, exponent);
    box.size = alpha::times_power_of_two(size, exponent);
    return box;
  }
};

/// The points after each point has been moved into the box by entire periods.
struct Folded {
  Points points;
  Box box;
};

/// Reduces the coordinates along closed axes modulo the periods. Coordinates and periods are first
/// rounded to multiples of a power of two, which changes them by at most 2^-51 of the size of the
/// box. After that, adding entire periods needs no rounding. Numbers that are already such
/// multiples do not change. Coordinates along open axes do not change.
/// @param period the period of each axis; 0 if the axis is open. At least one axis is closed.
/// @throws Error (usage) unless there is one period per axis, and none of them is negative or
/// infinite; Error (bad_data) if a period rounds to 0, or if the size is beyond the range of
/// doubles.
Folded fold_points(PointsView points, std::span<const double> weights,
                   std::span<const double> period);

}  // namespace ph::alpha
