// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/diagram/point_tree.hpp"
#include "ph/distances.hpp"

namespace ph::diagram {

/// The finite end of a bar, and the bar's place in the input.
struct PlacedEnd {
  double value;
  std::uint32_t place;
};

/// The bars of a diagram, grouped by which of their ends are finite. A bar with one infinite end is
/// represented by its finite end.
struct DiagramParts {
  std::vector<Point> finite;  // longest first; bars of equal length are in their original order
  std::vector<std::uint32_t> places;
  // rays[0] contains the births of the bars that never die. rays[1] contains the deaths of the bars
  // that have no birth.
  std::vector<PlacedEnd> rays[2];
  std::vector<std::uint32_t> lines;  // bars without birth and death

  /// Leaves out bars of length 0. @param function the name of the calling function, for messages.
  /// @throws Error (bad_data) on a NaN, or on a bar that dies before it is born.
  DiagramParts(std::span<const Bar> bars, std::string_view function);
};

/// True if the infinite bars can be paired, that is, both diagrams have the same number of infinite
/// bars of each kind.
bool have_as_many_infinite(const DiagramParts& a, const DiagramParts& b);

/// Pairs the infinite bars of each kind in the order of their finite ends, and appends the pairs.
/// This is optimal, because pairs that cross have no advantage on a line. Both diagrams must have
/// the same number of infinite bars of each kind.
void pair_infinite(const DiagramParts& a, const DiagramParts& b,
                   std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

/// @throws Error (usage) if a number is out of its range.
void check(const DistanceLimits& limits, std::string_view function);

inline bool is_enough(const DistanceBounds& bounds, const DistanceLimits& limits) {
  return bounds.value <= (1 + limits.relative_error) * bounds.lower ||
         bounds.value <= bounds.lower || bounds.lower > limits.at_most;
}

}  // namespace ph::diagram
