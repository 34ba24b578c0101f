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
// inference for probability measures, 2011): the root mean square of the distances to its k nearest
// points, the first of which is the point itself. It has the unit of the distance, and is small
// where points are dense and large at outliers. Twice this distance, used as births of a Rips
// filtration with WeightExponent::one, gives the DTM filtration of Anai et al. in diameters.

/// The distance of each of `points` to the empirical measure of all these points. Uses a k-d tree
/// where that is faster (Euclidean, Manhattan, Chebyshev and Minkowski distance in at most 8
/// dimensions, for k from 2 to 513): usually O(n k log n), otherwise O(n^2).
/// @param points one point per row. @param p exponent of PointDistance::minkowski.
/// @param neighbours k, from 1 to the number of points.
/// @throws Error (usage) if k is out of range; Error (bad_data) as PointMetric.
std::vector<double> distance_to_measure(PointsView points, Index neighbours,
                                        PointDistance distance = PointDistance::euclidean,
                                        double p = 2,
                                        const RunContext& context = default_context());

namespace detail {
void check_neighbours(Index neighbours, Index size);
/// The root mean square of `distances` and one more distance, which is 0: the point's distance from
/// itself.
double root_mean_square(std::span<const double> distances);
}  // namespace detail

/// The distance of each point of a metric to the empirical measure of all its points. O(n^2).
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
    std::ranges::sort(nearest);  // a fixed order gives a fixed sum
    result.push_back(detail::root_mean_square(nearest));
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(n));
  }
  return result;
}

}  // namespace ph
