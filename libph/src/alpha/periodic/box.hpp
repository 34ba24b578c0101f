// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "libph/src/alpha/sites/power_of_two.hpp"
#include "ph/points.hpp"

namespace ph::alpha {

/// A box whose opposite faces are glued along some axes, which are *closed*. It starts at 0.
struct Box {
  std::array<double, 3> period{};  ///< by axis; 0 if the axis is open
  /// At least the diagonal of the bounding box of the points inside. No empty sphere extends beyond
  /// the box by more than twice this size.
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

/// Points, moved into their box.
struct Folded {
  Points points;
  Box box;
};

/// Takes the coordinates of closed axes modulo their periods. Coordinates and periods are first
/// rounded to multiples of a power of two, at most 2^-51 of the size of the box; adding entire
/// periods then needs no rounding. Numbers that already are such multiples do not change, and open
/// axes do not change.
/// @param period one per axis, 0 if the axis is open. At least one axis is closed.
/// @throws Error (usage) unless there is one period per axis, none of them negative or infinite;
/// Error (bad_data) on a period that rounds to 0, and on sizes beyond the range of doubles.
Folded fold_points(PointsView points, std::span<const double> weights,
                   std::span<const double> period);

}  // namespace ph::alpha
