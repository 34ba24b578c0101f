// SPDX-License-Identifier: MIT
/// Tests which bars are longer than chance explains, and whether groups of barcodes differ.
///
/// Functions that draw random numbers take a seed, and return the same result for the same seed,
/// whatever the number of threads.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

// ---- a p-value for each bar

/// Filtrations of point sets by distance.
enum class DistanceFiltration {
  rips,  ///< Vietoris-Rips complexes
  cech,  ///< Čech complexes, and alpha complexes, whose bars are the same
};

/// For each bar, the probability that noise alone produces a bar that stands out at least as much.
struct BarPValues {
  /// One number per bar, by position: the probability that a bar of noise has at least this ratio
  /// of death to birth. 1 for bars of length 0. NaN for bars that never die, because they have no
  /// such ratio.
  std::vector<double> p;
  /// The p-values, corrected for the number of bars tested (Bonferroni): with probability 1 -
  /// alpha, all bars whose number here is at most alpha are real.
  std::vector<double> corrected;
  std::size_t tested = 0;  ///< number of bars with a ratio: finite and longer than 0
};

/// p-values of the bars of one dimension k >= 1 of a point set. For bars of noise, log log (death /
/// birth), shifted to a fixed mean, follows the same left-skewed Gumbel law, whatever the
/// distribution of the points is (a conjecture, tested on many distributions). Values may be radii,
/// diameters or their squares: p is the same.
///
/// Source: Bobrowski, Skraba, A universal null-distribution for topological data analysis, 2023.
/// Needs no resampling. O(n). With few bars the p-values say little, because the shift is the mean
/// of these bars.
/// @param bars the bars of one dimension; the dimension itself is ignored. @param filtration the
/// filtration of the bars.
/// @throws Error (bad_data) on a NaN, a death before its birth, or a birth at 0 or below.
BarPValues universal_p_values(std::span<const Bar> bars, DistanceFiltration filtration);

// ---- a confidence radius

struct ConfidenceOptions {
  double alpha = 0.05;           ///< the probability of error: above 0, below 1
  std::size_t subsamples = 100;  ///< at least 1
  std::size_t size = 0;          ///< points per subsample; 0: n / ln n; otherwise 1 to n
  std::uint64_t seed = 0;
};

/// A bound for the distance between a sample of points and the entire set that it was drawn from: a
/// number c such that their Hausdorff distance is at most c with probability 1 - alpha, in the
/// limit of many points. The bottleneck distance between the barcodes of the distance function is
/// then at most c, and bars longer than 2 c are real. The values of a Vietoris-Rips filtration are
/// diameters, which are twice as large: there, bars longer than 4 c are real.
///
/// Source: Fasy, Lecci, Rinaldo, Wasserman, Balakrishnan, Singh, Confidence sets for persistence
/// diagrams, 2014, section 4.1: twice the (1 - alpha)-quantile of the distances between the set and
/// its subsamples. The estimate is conservative: expect it to be large. Threads share the
/// subsamples; for each point, the nearest point of the subsample is found.
/// @param points one per row, finite, Euclidean. @return c, in the unit of the points.
/// @throws Error (usage) on no points or an option out of its range; Error (bad_data) on a number
///         that is not finite; Error (resource, cancelled).
double confidence_radius(PointsView points, const ConfidenceOptions& options = {},
                         const RunContext& context = default_context());

// ---- a confidence band

struct BandOptions {
  double alpha = 0.05;             ///< the probability of error: above 0, below 1
  std::size_t repetitions = 1000;  ///< repetitions of the bootstrap, at least 1
  std::uint64_t seed = 0;
};

/// The mean of functions on a grid, and a band of equal width around it.
struct ConfidenceBand {
  std::vector<double> mean;  ///< one number per place of the grid
  double half_width = 0;     ///< the band is mean ± half_width
};

/// A uniform confidence band for the mean of functions, such as landscapes or silhouettes of
/// samples: with probability 1 - alpha, in the limit of many samples, the true mean lies inside the
/// band everywhere at once.
///
/// Source: Chazal, Fasy, Lecci, Rinaldo, Wasserman, Stochastic convergence of persistence
/// landscapes and silhouettes, 2014: the multiplier bootstrap, with normal multipliers.
/// O(repetitions · numbers); threads share the repetitions.
/// @param functions one row per sample, `samples` rows of equal length; numbers of at most 1e300 in
///        absolute value.
/// @param samples at least 2.
/// @throws Error (usage) on fewer samples, rows that differ in length, or an option out of its
///         range; Error (bad_data) on a NaN or a number beyond that limit; Error (resource,
///         cancelled).
ConfidenceBand multiplier_bootstrap(std::span<const double> functions, std::size_t samples,
                                    const BandOptions& options = {},
                                    const RunContext& context = default_context());

// ---- a test for differences between groups

struct PermutationOptions {
  std::size_t shuffles = 1000;  ///< at least 1
  double power = 1;             ///< exponent of the distances: finite, above 0
  std::uint64_t seed = 0;
};

struct PermutationTest {
  /// (1 + the number of shuffles whose loss is at most the observed loss) / (1 + the number of all
  /// shuffles). If all groups follow one distribution, the probability of p <= t is at most t.
  double p = 1;
  /// The observed loss: for each group, half the mean of distance^power over all pairs within the
  /// group, summed over the groups. Infinite if doubles cannot hold it.
  double loss = 0;
};

/// Tests whether groups of barcodes differ: compares the mean distance within groups with the mean
/// distances that result when the labels are shuffled.
///
/// Source: Robinson, Turner, Hypothesis testing for topological data analysis, 2017. O(shuffles ·
/// n²); threads share the shuffles.
/// @param distances the distance between each pair of barcodes, finite. @param groups the group
///        number of each barcode; there must be at least two groups, each with at least two
///        members.
/// @throws Error (usage) on groups that break this rule or an option out of its range; Error
///         (bad_data) on an infinite distance; Error (cancelled).
PermutationTest permutation_test(const DistanceMatrix& distances,
                                 std::span<const std::int64_t> groups,
                                 const PermutationOptions& options = {},
                                 const RunContext& context = default_context());

}  // namespace ph
