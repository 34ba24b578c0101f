// SPDX-License-Identifier: MIT
/// Which bars are more than chance, and which groups of barcodes differ.
///
/// What draws random numbers takes a seed, and gives the same result for the same seed, whatever
/// the number of threads.
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
  cech,  ///< Čech complexes, and alpha complexes, which have the same bars
};

/// How likely a bar is that stands out as much, were there noise only.
struct BarPValues {
  /// A number for each bar, by place: the probability that a bar of noise has a ratio of death and
  /// birth as large. 1 of bars of length 0. NaN of bars that never die: there is no such ratio.
  std::vector<double> p;
  /// The same, corrected for the number of bars that were tested (Bonferroni): bars at most alpha
  /// here are all real with probability 1 - alpha.
  std::vector<double> corrected;
  std::size_t tested = 0;  ///< bars that have a ratio: finite ones longer than 0
};

/// p-values of the bars of one dimension k >= 1 of a point set: log log (death / birth), shifted to
/// the mean it has for noise, follows one law whatever the points are drawn from (a conjecture that
/// was tested on many distributions; a left-skewed Gumbel law). Values may be radii, diameters, or
/// squares of them: p is the same.
///
/// Source: Bobrowski, Skraba, A universal null-distribution for topological data analysis, 2023.
/// Needs no resampling. O(n). Few bars say little: the shift is their mean.
/// @param bars of one dimension, which is not looked at. @param filtration what they are of.
/// @throws Error (bad_data) on a NaN, a death before its birth, or a birth at 0 or below.
BarPValues universal_p_values(std::span<const Bar> bars, DistanceFiltration filtration);

// ---- a confidence radius

struct ConfidenceOptions {
  double alpha = 0.05;           ///< the probability to be wrong: above 0, below 1
  std::size_t subsamples = 100;  ///< at least 1
  std::size_t size = 0;          ///< points of each; 0: n / ln n. Else from 1 to n.
  std::uint64_t seed = 0;
};

/// How far points that were drawn from a set may be from the whole of it: c, such that the
/// Hausdorff distance is at most c with probability 1 - alpha, as the number of points grows. So
/// the bottleneck distance of the barcodes of the distance function is at most c, and bars longer
/// than 2 c are real. In a Vietoris-Rips filtration by diameters numbers are twice as large: there
/// bars longer than 4 c are.
///
/// Source: Fasy, Lecci, Rinaldo, Wasserman, Balakrishnan, Singh, Confidence sets for persistence
/// diagrams, 2014, section 4.1: twice the (1 - alpha)-quantile of the distances of the set from its
/// subsamples. The answer is careful: expect it to be large. Subsamples are shared by threads; each
/// searches the nearest of its points for each point.
/// @param points one a row, finite, Euclidean. @return c, in the unit of the points.
/// @throws Error (usage) on no points or an option out of its range; Error (bad_data) on a number
///         that is not finite; Error (resource, cancelled).
double confidence_radius(PointsView points, const ConfidenceOptions& options = {},
                         const RunContext& context = default_context());

// ---- a confidence band

struct BandOptions {
  double alpha = 0.05;             ///< the probability to be wrong: above 0, below 1
  std::size_t repetitions = 1000;  ///< of the bootstrap, at least 1
  std::uint64_t seed = 0;
};

/// The mean of functions on a grid, and a band of equal width around it.
struct ConfidenceBand {
  std::vector<double> mean;  ///< a number for each place of the grid
  double half_width = 0;     ///< the band is mean ± half_width
};

/// A uniform confidence band for the mean of functions, such as landscapes or silhouettes of
/// samples: the true mean lies in it everywhere at once with probability 1 - alpha, as the number
/// of samples grows.
///
/// Source: Chazal, Fasy, Lecci, Rinaldo, Wasserman, Stochastic convergence of persistence
/// landscapes and silhouettes, 2014: the multiplier bootstrap, with normal multipliers.
/// O(repetitions · numbers); repetitions are shared by threads.
/// @param functions a row for each sample, `samples` rows of equal length; numbers of at most
///        1e300 in absolute value.
/// @param samples at least 2.
/// @throws Error (usage) on fewer samples, rows that differ in length, or an option out of its
///         range; Error (bad_data) on a number beyond that; Error (resource, cancelled).
ConfidenceBand multiplier_bootstrap(std::span<const double> functions, std::size_t samples,
                                    const BandOptions& options = {},
                                    const RunContext& context = default_context());

// ---- a test whether groups differ

struct PermutationOptions {
  std::size_t shuffles = 1000;  ///< at least 1
  double power = 1;             ///< of the distances: finite, above 0
  std::uint64_t seed = 0;
};

struct PermutationTest {
  /// (shuffles whose loss is at most the observed one + 1) / (shuffles + 1): were the groups drawn
  /// from one distribution, it would be at most t with probability t.
  double p = 1;
  /// The observed one: Σ over groups of the mean within of the distances' power, halved; infinite
  /// where doubles cannot hold it.
  double loss = 0;
};

/// Whether groups of barcodes differ, by their distances: labels are shuffled, and the mean
/// distance within groups is compared. Two groups or more.
///
/// Source: Robinson, Turner, Hypothesis testing for topological data analysis, 2017. O(shuffles ·
/// n²); shuffles are shared by threads.
/// @param distances of all pairs, finite. @param groups a number for each, of its group: at least
///        two groups of at least two.
/// @throws Error (usage) on other groups or an option out of its range; Error (bad_data) on an
///         infinite distance; Error (cancelled).
PermutationTest permutation_test(const DistanceMatrix& distances,
                                 std::span<const std::int64_t> groups,
                                 const PermutationOptions& options = {},
                                 const RunContext& context = default_context());

}  // namespace ph
