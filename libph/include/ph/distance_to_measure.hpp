// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/metric/metric.hpp"
#include "ph/run_context.hpp"

namespace ph {

// The distance of each point to the empirical measure (Chazal, Cohen-Steiner, Mérigot, Geometric
// inference for probability measures, 2011): the root of the mean square of the distances to its k
// nearest points, of which it is the first itself. In units of the distance; small where points are
// dense, large at outliers. Twice as much, taken for the births of a Rips filtration with
// WeightExponent::one, gives the DTM filtration of Anai et al. in diameters.

/// Of points. With a k-d tree where that pays (Euclidean, Manhattan, Chebyshev and Minkowski
/// distance in few dimensions): O(n k log n) as a rule, else O(n^2).
/// @param points one point a row. @param p exponent of PointDistance::minkowski.
/// @param neighbours k, from 1 to the number of points.
/// @throws Error (usage) on another k; Error (bad_data) as PointMetric.
std::vector<double> distance_to_measure(PointsView points, Index neighbours,
                                        PointDistance distance = PointDistance::euclidean,
                                        double p = 2,
                                        const RunContext& context = default_context());

namespace detail {
void check_neighbours(Index neighbours, Index size);
/// The root of the mean square of distances and of one that is 0.
double root_mean_square(std::span<const double> distances);
}  // namespace detail

/// Of any metric. O(n^2).
template <Metric M>
std::vector<double> distance_to_measure(const M& metric, Index neighbours,
                                        const RunContext& context = default_context()) {
  const Index n = metric.size();
  detail::check_neighbours(neighbours, n);
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(n));
  std::pmr::vector<double> distances(&context.memory);
  Ticker ticker(context, "distance to measure", static_cast<std::uint64_t>(n));
  for (Index i = 0; i < n; ++i) {
    distances.clear();
    for (Index j = 0; j < n; ++j)
      if (i != j) distances.push_back(metric(i, j));
    const auto others = static_cast<std::size_t>(neighbours - 1);
    if (others < distances.size())
      std::ranges::nth_element(distances, distances.begin() + static_cast<std::ptrdiff_t>(others));
    const std::span<double> nearest = std::span(distances).first(others);
    std::ranges::sort(nearest);  // one order, one sum
    result.push_back(detail::root_mean_square(nearest));
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(n));
  }
  return result;
}

}  // namespace ph
