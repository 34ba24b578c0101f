// SPDX-License-Identifier: MIT
/// Distances of persistence diagrams.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/distance_matrix.hpp"
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
/// Some 3 to 5 rounds to 1 %, 20 to the end, each of some searches in a k-d tree for each bar;
/// memory O(n). Where an auction takes too many bids, shortest augmenting paths follow (Jonker,
/// Volgenant, 1987): O(n) searches for each bar at most.
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

/// The sliced Wasserstein distance of two persistence diagrams (order 1), approximated by
/// directions. Points of a diagram, and the points of the diagonal nearest to those of the other
/// one, are projected to a line. What is between the two sorted lists of numbers, the sum of
/// |x_i - y_i|, is averaged over the directions of the line: angles k π / directions, k = 0 …
/// directions - 1. They go once around: a line at π is the one at 0, and counts once.
///
/// Bars that never die, and those that were always there, add what wasserstein_distance adds for
/// them. It is infinite where their numbers differ. Bars of length 0 do not count.
///
/// It is equivalent to wasserstein_distance of order 1, not equal to it: at most 2 √2 times as
/// large, however many directions. exp(-distance) is a positive definite kernel. Source: Carrière,
/// Cuturi, Oudot, Sliced Wasserstein kernel for persistence diagrams, 2017. O(directions · n log
/// n), directions shared by threads; the result does not depend on them.
/// @param directions at least 1.
/// @throws Error (usage) on fewer directions; else as bottleneck_distance.
double sliced_wasserstein_distance(std::span<const Bar> a, std::span<const Bar> b,
                                   int directions = 50,
                                   const RunContext& context = default_context());

/// A distance of two diagrams, as `[](auto a, auto b, auto& context) { return
/// bottleneck_distance(a, b, context); }`. Called by several threads.
using DiagramDistance =
    std::function<double(std::span<const Bar>, std::span<const Bar>, const RunContext&)>;

/// The distances of all pairs of diagrams. Threads share the pairs, those with the most bars first;
/// the result does not depend on them, nor on the order in which they are done.
/// @param distance symmetric; called once for each pair, with a context of one thread that can be
///        stopped, and with an equal share of the memory that is left.
/// @throws what `distance` throws; Error (cancelled).
DistanceMatrix diagram_distances(std::span<const std::span<const Bar>> diagrams,
                                 const DiagramDistance& distance,
                                 const RunContext& context = default_context());

/// The distances of each of some diagrams from each of others, row by row: otherwise the same.
/// @returns diagrams.size() · others.size() numbers.
std::vector<double> diagram_distances(std::span<const std::span<const Bar>> diagrams,
                                      std::span<const std::span<const Bar>> others,
                                      const DiagramDistance& distance,
                                      const RunContext& context = default_context());

struct BarycentreOptions {
  int most_rounds = 100;  ///< at least 0: then the medoid is the result
  /// Ends after a round that lowers the root mean square by this part of it, or less. At least 0.
  double least_gain = 1e-6;
};

/// A diagram in the middle of others.
struct Barycentre {
  std::vector<Bar> bars;        ///< ascending by birth, then death; of dimension 0
  double root_mean_square = 0;  ///< of the distances to the diagrams
  int rounds = 0;               ///< that lowered it
  bool converged = false;       ///< whether it ended before the most rounds
};

/// A barycentre (Fréchet mean) of persistence diagrams: a local minimum of the mean square of the
/// Wasserstein distances, of order 2 and Euclidean ground norm, from a diagram to those given. It
/// begins at their medoid, the diagram with the least sum of squares (of several the first one;
/// distances within 1 %), and alternates: each diagram is matched with it; each of its bars moves
/// to the mean of its partners, of which those on the diagonal count as the point nearest to the
/// mean of the others. A bar without a partner in it becomes a new bar, as near to the diagonal as
/// all other diagrams want it; one with all partners on the diagonal is gone. So there may be bars
/// that are N times as short as those of one of N diagrams.
///
/// Infinite bars are averaged in the order of their finite ends. Bars of length 0 do not count.
/// Sources: Turner, Mileyko, Mukherjee, Harer, Fréchet means for distributions of persistence
/// diagrams, 2014 (alternation; it lowers the mean square until it ends); Vidal, Budin, Tierny,
/// Progressive Wasserstein barycenters of persistence diagrams, 2020.
/// Some 1 to 15 rounds of N matchings, after N²/2 distances. Diagrams are shared by threads; the
/// result does not depend on them.
/// @throws Error (usage) on no diagram or options out of range; Error (bad_data) on a NaN, a death
///         before its birth or numbers of infinite bars that differ; Error (resource, cancelled).
Barycentre barycentre(std::span<const std::span<const Bar>> diagrams,
                      const BarycentreOptions& options = {},
                      const RunContext& context = default_context());

}  // namespace ph
