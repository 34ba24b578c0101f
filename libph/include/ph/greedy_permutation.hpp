// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <utility>
#include <vector>

#include "ph/detail/metric/metric.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Limits of a greedy permutation; it ends at the first one reached.
struct GreedyLimits {
  Index points = std::numeric_limits<Index>::max();  ///< number of points, >= 1
  double radius = 0;  ///< covering radius, >= 0; 0: until every point or a copy of it is taken
};

/// Points in the order of farthest-point sampling (Gonzalez, Clustering to minimize the maximum
/// intercluster distance, 1985): after point 0, each point is the one that is farthest from all
/// points before it; among equals, the point with the smallest number.
struct GreedyPermutation {
  std::vector<std::uint32_t> points;
  /// For points[k], the distance to the nearest of points[0 … k); infinite for k = 0. The radii
  /// never increase.
  std::vector<double> radii;
  /// Each point of the entire set is at most this far from one of `points`.
  double covering_radius = 0;

  /// The points, ascending, as RipsOptions::vertices requires.
  std::vector<std::uint32_t> ascending() const;
};

// To choose k of n points, both functions compute O(n k) distances and take O(n) memory.
//
// The quality of a subsample: Let e be its covering radius, and let the triangle inequality hold.
// The Rips barcodes of the entire set and of the subsample can be matched such that each bar of the
// subsample is born and dies no earlier than its partner, and at most 2e later; only bars of length
// 2e or less, of either barcode, are left unmatched. See docs/explanation/approximation.md.

/// The permutation of points; it is the same as the permutation for their metric.
/// @param points one point per row. @param p exponent of PointDistance::minkowski.
/// @throws Error (bad_data) as PointMetric; Error (usage) on limits out of range.
GreedyPermutation greedy_permutation(PointsView points, const GreedyLimits& limits = {},
                                     PointDistance distance = PointDistance::euclidean,
                                     double p = 2, const RunContext& context = default_context());

namespace detail {
void check(const GreedyLimits& limits, Index size);
}

/// The permutation of the points of any metric.
template <Metric M>
GreedyPermutation greedy_permutation(const M& metric, const GreedyLimits& limits = {},
                                     const RunContext& context = default_context()) {
  const Index n = metric.size();
  detail::check(limits, n);
  GreedyPermutation result;
  result.covering_radius = n == 0 ? 0 : std::numeric_limits<double>::infinity();
  std::pmr::vector<double> nearest(static_cast<std::size_t>(n), result.covering_radius,
                                   &context.memory);
  Ticker ticker(context, "greedy permutation",
                static_cast<std::uint64_t>(std::min(n, limits.points)));
  for (Index next = 0; static_cast<Index>(result.points.size()) < std::min(n, limits.points);) {
    result.points.push_back(static_cast<std::uint32_t>(next));
    result.radii.push_back(result.covering_radius);
    nearest[static_cast<std::size_t>(next)] = 0;
    Index farthest = 0;
    for (Index i = 0; i < n; ++i) {
      double& of_i = nearest[static_cast<std::size_t>(i)];
      if (of_i > 0) of_i = std::min<double>(of_i, metric(i, next));
      if (of_i > nearest[static_cast<std::size_t>(farthest)]) farthest = i;  // mutant: greedy-tie
    }
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(n));
    next = farthest;
    result.covering_radius = nearest[static_cast<std::size_t>(farthest)];
    if (result.covering_radius <= limits.radius) break;
  }
  return result;
}

}  // namespace ph
