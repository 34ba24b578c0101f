// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "alpha/sites/power_of_two.hpp"
#include "ph/points.hpp"

namespace ph::alpha {

/// A box whose opposite faces are glued along some axes, which are *closed*. It begins at 0.
struct Box {
  std::array<double, 3> period{};  ///< by axis; 0: the axis is open
  /// No empty sphere reaches farther beyond the box than twice this. It is at least the diagonal of
  /// what is inside.
  double size = 0;

  bool is_closed(std::size_t axis) const { return period[axis] > 0; }
  /// The same in other units.
  Box times_power_of_two(int exponent) const {
    Box box = *this;
    for (double& length : box.period) length = alpha::times_power_of_two(length, exponent);
    box.size = alpha::times_power_of_two(size, exponent);
    return box;
  }
};

/// Points in their box.
struct Folded {
  Points points;
  Box box;
};

/// Takes the coordinates of closed axes modulo their periods. Both are first rounded to multiples
/// of a power of two, 2^-51 of the size of the box or less: whole periods can then be added without
/// rounding. Numbers that are such multiples stay what they are, and so do open axes.
/// @param period one an axis, 0 if it is open. Some axis is closed.
/// @throws Error (usage) on other numbers of periods and on those that are negative or not finite;
///         Error (bad_data) on one that is rounded to 0, and on sizes beyond doubles.
Folded fold_points(PointsView points, std::span<const double> weights,
                   std::span<const double> period);

}  // namespace ph::alpha
