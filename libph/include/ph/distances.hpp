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

/// What the Wasserstein distance is of.
struct WassersteinOptions {
  double order = 1;  ///< p: at least 1, finite. Infinity is the bottleneck distance.
  /// q, the norm in which a pair is apart: at least 1; 2 is the Euclidean one, infinity the
  /// maximum.
  double ground = kInfinity;
  DistanceLimits limits = {};
};

/// The p-Wasserstein distance of two persistence diagrams: the p-th root of the least sum, over all
/// ways to pair bars off, each in at most one pair, of ‖(birth, death) of one - those of the
/// other‖_q^p over pairs and of the distance from the diagonal, 2^(1/q - 1) · length, to the power
/// of p over bars left over.
///
/// Bars that never die are paired with such bars only, by birth, |difference|^p; those that were
/// always there by death. It is infinite where their numbers differ. Bars of length 0 do not count.
///
/// Certified: `value` is what a matching costs, and prices of the bars prove that none costs less
/// than `lower` (duality of linear programs). Without a relative error both are the distance but
/// for rounding: the costs to the power of p agree to 1e-13, or to 2e-15 of what all bars would
/// cost on the diagonal.
///
/// Sources: Bertsekas, The auction algorithm: a distributed relaxation method for the assignment
/// problem, 1988; Bertsekas, Castañon, A forward/reverse auction algorithm for asymmetric
/// assignment problems, 1992; Kerber, Morozov, Nigmetov, Geometry helps to compare persistence
/// diagrams, 2017 (bids by a k-d tree with weights). There is one diagonal, in place of a copy of
/// each bar on it.
///
/// Some 5 rounds to 1 %, 20 to the end, each of some searches in a k-d tree for each bar; memory
/// O(n). Where an auction takes too many bids, shortest augmenting paths follow (Jonker, Volgenant,
/// 1987): O(n) searches for each bar at most.
/// @param a, b bars of one dimension each (their dimension is not looked at), in any order.
/// @throws Error (usage) on options out of their range; Error (bad_data) on a NaN, or a death
///         before its birth; Error (resource, cancelled).
DistanceBounds wasserstein_distance(std::span<const Bar> a, std::span<const Bar> b,
                                    const WassersteinOptions& options = {},
                                    const RunContext& context = default_context());

/// A matching of all bars of two diagrams.
struct WassersteinMatching {
  DistanceBounds distance;  ///< infinite: then there are no pairs
  /// Places in `a` and in `b`, ascending; -1 is the diagonal, and comes last. Each bar of both is
  /// in one pair, those of length 0 with the diagonal.
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
};

/// Which bars the Wasserstein distance pairs: the matching costs distance.value. Cost, parameters
/// and errors are those of wasserstein_distance.
WassersteinMatching wasserstein_matching(std::span<const Bar> a, std::span<const Bar> b,
                                         const WassersteinOptions& options = {},
                                         const RunContext& context = default_context());

}  // namespace ph
