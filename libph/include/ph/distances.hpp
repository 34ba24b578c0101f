// SPDX-License-Identifier: MIT
/// Distances of persistence diagrams.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// How much of a distance has to be known.
struct DistanceLimits {
  /// Enough is value <= (1 + relative_error) · lower. 0: the distance itself. At least 0, finite.
  double relative_error = 0;
  /// Enough is lower > at_most: how much farther apart they are does not matter. Not NaN.
  double at_most = kInfinity;
};

/// What is known of a distance: lower <= distance <= value. If it is infinite so are both.
struct DistanceBounds {
  double value = 0;
  double lower = 0;
};

/// The bottleneck distance W∞ of two persistence diagrams: the least d such that bars can be paired
/// off, each in at most one pair, with births and deaths of a pair at most d apart and bars left
/// over at most 2 d long. Exact: the largest of the differences that decide it, as computed in
/// double precision; no approximation. The ground norm is the maximum norm.
///
/// Bars that never die are paired with such bars only, by birth; those that were always there by
/// death. It is infinite where their numbers differ. Bars of length 0 do not count.
///
/// Sources: Efrat, Itai, Katz, Geometry helps in bottleneck matching and related problems, 2001
/// (matchings whose neighbours a search structure finds and gives away); Kerber, Morozov,
/// Nigmetov, Geometry helps to compare persistence diagrams, 2017. In place of copies on the
/// diagonal: bars longer than 2 d of one diagram can be paired and so can those of the other, each
/// for itself, if and only if both can at once (Mendelsohn and Dulmage, 1958). In place of a list
/// of all differences: bars that have too few partners (Hall, 1935) say how large d is at least.
///
/// Some 2 to 30 values are tried, each by O(n^1.5) searches for neighbours at most; memory O(n).
/// @param a, b bars of one dimension each (their dimension is not looked at), in any order.
/// @throws Error (bad_data) on a NaN, or a death before its birth; Error (resource, cancelled).
double bottleneck_distance(std::span<const Bar> a, std::span<const Bar> b,
                           const RunContext& context = default_context());

/// The bottleneck distance as far as it has to be known: the same without limits.
/// @throws Error (usage) on limits out of their range; else as bottleneck_distance.
DistanceBounds bottleneck_bounds(std::span<const Bar> a, std::span<const Bar> b,
                                 const DistanceLimits& limits,
                                 const RunContext& context = default_context());

/// A pairing of two diagrams that costs no more than their bottleneck distance.
struct BottleneckMatching {
  double distance = 0;  ///< infinite: then there are no pairs
  /// Places in `a` and in `b`, ascending in `a`, each bar in at most one pair. Bars whose length is
  /// 2 · distance or less may be in none: they go to the diagonal.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
};

/// Which bars the bottleneck distance pairs. Both ends of a pair are at most the distance apart,
/// and bars in no pair are at most twice as long as it. Cost, parameters and errors are those of
/// bottleneck_distance; fewer than 2³² bars each.
BottleneckMatching bottleneck_matching(std::span<const Bar> a, std::span<const Bar> b,
                                       const RunContext& context = default_context());

}  // namespace ph
