// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "ph/detail/metric/nearest_distances.hpp"
#include "ph/run_context.hpp"

namespace ph {

// The distance of each point to the empirical measure (Chazal, Cohen-Steiner, Mérigot, Geometric
// inference for probability measures, 2011): the root mean square of the distances to its k nearest
// points, the first of which is the point itself. It has the unit of the distance, and is small
// where points are dense and large at outliers. Twice this distance, used as births of a Rips
// filtration with WeightExponent::one, gives the DTM filtration of Anai et al. in diameters.

/// The distance of each of `points` to the empirical measure of all these points, usually in O(n k
/// log n), see detail::for_each_nearest.
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
/// itself. @param distances ascending, because a fixed order gives a fixed sum.
double root_mean_square(std::span<const double> distances);
}  // namespace detail

/// The distance of each point of a metric to the empirical measure of all its points. O(n^2).
template <Metric M>
std::vector<double> distance_to_measure(const M& metric, Index neighbours,
                                        const RunContext& context = default_context()) {
  const Index n = metric.size();
  detail::check_neighbours(neighbours, n);
  std::vector<double> result(static_cast<std::size_t>(n));
  detail::for_each_nearest(
      metric, neighbours - 1, "distance to measure",
      [&](Index i, std::span<const double> nearest) {
        result[static_cast<std::size_t>(i)] = detail::root_mean_square(nearest);
      },
      context);
  return result;
}

// The core distance of a point is the distance to its k-th nearest other point; copies of the point
// count (Campello, Moulavi, Sander, Density-based clustering based on hierarchical density
// estimates, 2013, whose m_pts counts the point itself: k = m_pts - 1). It has the unit of the
// distance, and is small where points are dense. Used as births of a Rips filtration with
// WeightExponent::infinity, core distances give the mutual reachability distances of HDBSCAN* as
// values of edges: a point enters at its core distance, and an edge at the largest of its length
// and the core distances of its two ends. No distance is halved.

/// The core distance of each point, usually in O(n k log n), see detail::for_each_nearest.
/// @param points one point per row. @param p exponent of PointDistance::minkowski.
/// @param neighbours k, less than the number of points; 0: all core distances are 0.
/// @throws Error (usage) if k is out of range; Error (bad_data) as PointMetric.
std::vector<double> core_distances(PointsView points, Index neighbours,
                                   PointDistance distance = PointDistance::euclidean, double p = 2,
                                   const RunContext& context = default_context());

namespace detail {
void check_core_neighbours(Index neighbours, Index size);
}  // namespace detail

/// The core distance of each point of a metric. O(n^2).
template <Metric M>
std::vector<double> core_distances(const M& metric, Index neighbours,
                                   const RunContext& context = default_context()) {
  detail::check_core_neighbours(neighbours, metric.size());
  std::vector<double> result(static_cast<std::size_t>(metric.size()));
  if (neighbours > 0)
    detail::for_each_nearest(
        metric, neighbours, "core distances",
        [&](Index i, std::span<const double> nearest) {
          result[static_cast<std::size_t>(i)] = nearest.back();
        },
        context);
  return result;
}

}  // namespace ph
