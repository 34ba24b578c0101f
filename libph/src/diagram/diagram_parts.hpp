// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "diagram/point_tree.hpp"
#include "ph/barcode.hpp"
#include "ph/distances.hpp"

namespace ph::diagram {

/// The finite end of a bar, and its place among the bars that were given.
struct PlacedEnd {
  double value;
  std::uint32_t place;
};

/// Bars of a diagram by which of their ends are finite. The infinite ones by what is left of them.
struct DiagramParts {
  std::vector<Point> finite;  // the longest first, equally long ones as they were given
  std::vector<std::uint32_t> places;
  std::vector<PlacedEnd> rays[2];    // births of bars without death; deaths of those without birth
  std::vector<std::uint32_t> lines;  // neither

  /// Leaves bars of length 0 out. @param function the name for messages.
  /// @throws Error (bad_data) on a NaN, or a death before its birth.
  DiagramParts(std::span<const Bar> bars, std::string_view function);
};

/// Whether the infinite bars can be paired: there are as many of each kind.
bool have_as_many_infinite(const DiagramParts& a, const DiagramParts& b);

/// Places of infinite bars that are for each other: on a line nobody gains by crossing over.
/// Requires as many of each kind.
void pair_infinite(const DiagramParts& a, const DiagramParts& b,
                   std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

/// @throws Error (usage) on a number out of its range.
void check(const DistanceLimits& limits, std::string_view function);

inline bool is_enough(const DistanceBounds& bounds, const DistanceLimits& limits) {
  return bounds.value <= (1 + limits.relative_error) * bounds.lower ||
         bounds.value <= bounds.lower || bounds.lower > limits.at_most;
}

}  // namespace ph::diagram
