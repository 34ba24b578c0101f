// SPDX-License-Identifier: MIT
/// Distances between persistence diagrams.
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

/// The accuracy to which a distance must be known.
struct DistanceLimits {
  /// The search may stop once its bounds (see DistanceBounds) satisfy value <= (1 + relative_error)
  /// · lower. With 0, the result is the distance itself. Must be finite and at least 0.
  double relative_error = 0;
  /// The search may stop once lower > at_most: it does not matter how much larger the distance is.
  /// Must not be NaN.
  double at_most = kInfinity;
};

/// Bounds for a distance: lower <= distance <= value. If the distance is infinite, both bounds are
/// infinite.
struct DistanceBounds {
  double value = 0;
  double lower = 0;
};

/// The bottleneck distance W∞ between two persistence diagrams: the least d such that bars of one
/// diagram can be paired with bars of the other, where births and deaths of a pair differ by at
/// most d, and bars without a partner are at most 2 d long. The result is not approximated: it is
/// the difference that decides the distance, as computed in double precision. The ground norm is
/// the maximum norm.
///
/// Bars that never die are paired only with each other, by birth; bars born at -infinity are paired
/// only with each other, by death. The distance is infinite if the diagrams have different numbers
/// of such bars. Bars of length 0 do not count.
///
/// Sources: Efrat, Itai, Katz, Geometry helps in bottleneck matching and related problems, 2001
/// (matchings in which a search structure finds and removes neighbours); Kerber, Morozov, Nigmetov,
/// Geometry helps to compare persistence diagrams, 2017. No copies on the diagonal are needed: if
/// the bars longer than 2 d of one diagram can be paired, and the bars longer than 2 d of the other
/// can be paired, then a single pairing covers both (Mendelsohn and Dulmage, 1958). No list of all
/// differences is needed: bars with too few partners (Hall, 1935) give a lower bound for d.
///
/// About 2 to 30 values of d are tried, each with at most O(n^1.5) searches for neighbours. Memory:
/// O(n).
/// @param a, b the bars of one dimension each, in any order; their dimension is ignored.
/// @throws Error (bad_data) on a NaN, or a death before its birth; Error (resource, cancelled).
double bottleneck_distance(std::span<const Bar> a, std::span<const Bar> b,
                           const RunContext& context = default_context());

/// The bottleneck distance, computed to the accuracy that `limits` requires. Everything else is as
/// for bottleneck_distance.
/// @throws Error (usage) on limits out of their range; otherwise as bottleneck_distance.
DistanceBounds bottleneck_bounds(std::span<const Bar> a, std::span<const Bar> b,
                                 const DistanceLimits& limits,
                                 const RunContext& context = default_context());

/// A pairing between two diagrams whose cost is at most their bottleneck distance.
struct BottleneckMatching {
  double distance = 0;  ///< infinite: there are no pairs in that case
  /// Positions in `a` and in `b`, ascending in `a`, each bar in at most one pair. Bars of length 2
  /// · distance or less may have no partner; they are matched with the diagonal.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
};

/// A pairing that attains the bottleneck distance. Births and deaths of a pair differ by at most
/// that distance, and bars without a pair are at most twice that distance long. Running time,
/// parameters and errors are as for bottleneck_distance. For all distances, each diagram must have
/// fewer than 2³² - 1 bars.
BottleneckMatching bottleneck_matching(std::span<const Bar> a, std::span<const Bar> b,
                                       const RunContext& context = default_context());

/// The order and the ground norm of a Wasserstein distance.
struct WassersteinOptions {
  /// The exponent p: at least 1, finite. (In the limit of large p, the distance becomes the
  /// bottleneck distance.)
  double order = 1;
  /// The norm q that measures how far apart a pair is: at least 1; 2 is Euclidean, infinity is the
  /// maximum norm.
  double ground = kInfinity;
  DistanceLimits limits = {};
};

/// The p-Wasserstein distance between two persistence diagrams: the p-th root of the least cost
/// over all ways to pair bars, each in at most one pair. A pair costs ‖(birth, death) of one -
/// (birth, death) of the other‖_q^p; a bar without a partner costs its distance from the diagonal,
/// 2^(1/q - 1) · length, to the power of p.
///
/// Bars that never die are paired only with each other, by birth, at a cost of |difference|^p; bars
/// born at -infinity are paired only with each other, by death. The distance is infinite if the
/// diagrams have different numbers of such bars. Bars of length 0 do not count.
///
/// The result is certified: `value` is the cost of a matching, and prices of the bars prove that no
/// matching costs less than `lower` (linear programming duality). Without a relative error, both
/// bounds equal the distance up to rounding: their p-th powers agree to 1e-13 of their size, or to
/// 2e-15 of the cost of pairing all bars with the diagonal.
///
/// Sources: Bertsekas, The auction algorithm: a distributed relaxation method for the assignment
/// problem, 1988; Bertsekas, Castañon, A forward/reverse auction algorithm for asymmetric
/// assignment problems, 1992; Kerber, Morozov, Nigmetov, Geometry helps to compare persistence
/// diagrams, 2017 (bids are found in a k-d tree with weights). A single diagonal replaces the usual
/// copy of each bar on the diagonal.
///
/// About 3 to 5 rounds reach a relative error of 1 %, and about 20 rounds complete the search. Each
/// round makes a few searches in a k-d tree per bar. Memory: O(n). If an auction takes too many
/// bids, shortest augmenting paths complete the matching (Jonker, Volgenant, 1987), with at most
/// O(n) searches per bar.
/// @param a, b the bars of one dimension each, in any order; their dimension is ignored.
/// @throws Error (usage) on options out of their range; Error (bad_data) on a NaN, or a death
///         before its birth; Error (resource, cancelled).
DistanceBounds wasserstein_distance(std::span<const Bar> a, std::span<const Bar> b,
                                    const WassersteinOptions& options = {},
                                    const RunContext& context = default_context());

/// A matching of all bars of two diagrams.
struct WassersteinMatching {
  DistanceBounds distance;  ///< infinite: there are no pairs in that case
  /// Positions in `a` and in `b`, ascending; -1 is the diagonal and comes last. Each bar of both
  /// diagrams is in exactly one pair; bars of length 0 are paired with the diagonal.
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
};

/// A matching that attains the upper bound of the Wasserstein distance: its cost is distance.value.
/// Running time, parameters and errors are as for wasserstein_distance.
WassersteinMatching wasserstein_matching(std::span<const Bar> a, std::span<const Bar> b,
                                         const WassersteinOptions& options = {},
                                         const RunContext& context = default_context());

/// The sliced Wasserstein distance between two persistence diagrams (order 1), approximated by a
/// finite number of directions. The points of each diagram, and the points on the diagonal nearest
/// to the points of the other diagram, are projected onto a line. The difference between the two
/// sorted lists of numbers, Σ |x_i - y_i|, is averaged over the directions of the line, which are
/// the angles k π / directions for k = 0 … directions - 1. The directions cover half a turn,
/// because the line at π is the line at 0.
///
/// Bars that never die, and bars born at -infinity, contribute as much as they do to
/// wasserstein_distance. The distance is infinite if the diagrams have different numbers of such
/// bars. Bars of length 0 do not count.
///
/// This distance is equivalent to wasserstein_distance of order 1, but not equal: it is at most 2
/// √2 times as large, whatever the number of directions. exp(-distance) is a positive definite
/// kernel. Source: Carrière, Cuturi, Oudot, Sliced Wasserstein kernel for persistence diagrams,
/// 2017. O(directions · n log n). Threads share the directions; the result does not depend on the
/// number of threads.
/// @param directions at least 1.
/// @throws Error (usage) on fewer directions; otherwise as bottleneck_distance.
double sliced_wasserstein_distance(std::span<const Bar> a, std::span<const Bar> b,
                                   int directions = 50,
                                   const RunContext& context = default_context());

/// A distance between two diagrams, such as `[](auto a, auto b, auto& context) { return
/// bottleneck_distance(a, b, context); }`. Several threads may call it at once.
using DiagramDistance =
    std::function<double(std::span<const Bar>, std::span<const Bar>, const RunContext&)>;

/// The distance between each pair of diagrams. Threads share the pairs, the largest first; the
/// result depends neither on the threads nor on the order in which the pairs are computed.
/// @param distance symmetric; it is called once per pair, with a context for one thread, which can
///        be stopped and has an equal share of the remaining memory.
/// @throws what `distance` throws; Error (cancelled).
DistanceMatrix diagram_distances(std::span<const std::span<const Bar>> diagrams,
                                 const DiagramDistance& distance,
                                 const RunContext& context = default_context());

/// The distance from each of `diagrams` to each of `others`, row by row; everything else is as
/// above.
/// @returns diagrams.size() · others.size() numbers.
std::vector<double> diagram_distances(std::span<const std::span<const Bar>> diagrams,
                                      std::span<const std::span<const Bar>> others,
                                      const DiagramDistance& distance,
                                      const RunContext& context = default_context());

struct BarycentreOptions {
  int most_rounds = 100;  ///< at least 0; with 0 the medoid is the result
  /// Stops after a round that lowers the root mean square by this fraction or less. At least 0.
  double least_gain = 1e-6;
};

/// A barycentre of several diagrams, and how the search for it ended.
struct Barycentre {
  std::vector<Bar> bars;        ///< ascending by birth, then death; of dimension 0
  double root_mean_square = 0;  ///< root mean square of the distances to the diagrams
  int rounds = 0;               ///< rounds that lowered the mean by more than least_gain
  bool converged = false;       ///< true if a round gained no more than least_gain
};

/// A barycentre (Fréchet mean) of persistence diagrams: a local minimum of the mean square of the
/// Wasserstein distances (order 2, Euclidean ground norm) to the given diagrams. The search begins
/// at their medoid: the diagram with the least sum of squared distances to all diagrams; among
/// equals, the first one. The distances for this choice are computed to within 1 %. The search then
/// alternates two steps. First, each given diagram is matched with the current diagram. Then each
/// bar of the current diagram moves to the mean of its partners, where a partner on the diagonal
/// counts as the point of the diagonal nearest to the mean of the others. A bar without a partner
/// in the current diagram becomes a new bar, moved towards the diagonal by all diagrams that lack
/// it; a bar with all its partners on the diagonal is removed. The result may therefore have bars
/// that are only 1/N as long as a bar of one of the N diagrams.
///
/// Infinite bars are averaged in the order of their finite ends. Bars of length 0 do not count.
/// Sources: Turner, Mileyko, Mukherjee, Harer, Fréchet means for distributions of persistence
/// diagrams, 2014 (the alternation, which lowers the mean square until it ends); Vidal, Budin,
/// Tierny, Progressive Wasserstein barycenters of persistence diagrams, 2020. The search takes
/// about 1 to 15 rounds of N matchings each, after N²/2 distances. Threads share the diagrams; the
/// result does not depend on the number of threads.
/// @throws Error (usage) on no diagram or options out of range; Error (bad_data) on a NaN, a death
///         before its birth, or diagrams with different numbers of infinite bars; Error (resource,
///         cancelled).
Barycentre barycentre(std::span<const std::span<const Bar>> diagrams,
                      const BarycentreOptions& options = {},
                      const RunContext& context = default_context());

}  // namespace ph
