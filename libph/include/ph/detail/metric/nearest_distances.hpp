// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

#include "ph/detail/metric/metric.hpp"
#include "ph/run_context.hpp"

namespace ph::detail {

/// Receives a point and the distances to its k nearest other points, ascending.
using UseNearest = std::function<void(Index, std::span<const double>)>;

/// Calls `use` once for each point of a metric. O(n^2).
/// @param k from 0 to the number of points less one. @param stage the name of the work, for
/// progress.
template <Metric M>
void for_each_nearest(const M& metric, Index k, std::string_view stage, const UseNearest& use,
                      const RunContext& context) {
  const Index n = metric.size();
  const auto count = static_cast<std::size_t>(k);
  std::pmr::vector<double> distances(&context.memory);
  Ticker ticker(context, stage, static_cast<std::uint64_t>(n));
  for (Index i = 0; i < n; ++i) {
    distances.clear();
    for (Index j = 0; j < n; ++j)
      if (i != j) distances.push_back(metric(i, j));
    if (count < distances.size())
      std::ranges::nth_element(distances, distances.begin() + static_cast<std::ptrdiff_t>(count));
    const std::span<double> nearest = std::span(distances).first(count);
    std::ranges::sort(nearest);
    use(i, nearest);
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(n));
  }
}

/// The same for points. Uses a k-d tree where that is faster: for Euclidean, Manhattan, Chebyshev
/// and Minkowski distance in at most 8 dimensions and k from 1 to 512, usually O(n k log n).
/// `use` is then called by several threads, and in any order of the points.
/// @param p exponent of PointDistance::minkowski. @throws Error (bad_data) as PointMetric.
void for_each_nearest(PointsView points, Index k, PointDistance distance, double p,
                      std::string_view stage, const UseNearest& use, const RunContext& context);

}  // namespace ph::detail
