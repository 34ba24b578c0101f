// SPDX-License-Identifier: MIT
#include "ph/distance_to_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ph/error.hpp"

namespace ph {

void detail::check_neighbours(Index neighbours, Index size) {
  if (neighbours < 1 || neighbours > size) {
    throw Error(ErrorKind::usage, fmt::format("neighbours: found {}, expected 1 to the number of "
                                              "points, {}",
                                              neighbours, size));
  }
}

double detail::root_mean_square(std::span<const double> distances) {
  const double largest = distances.empty() ? 0 : std::ranges::max(distances);
  if (largest == 0 || std::isinf(largest)) return largest;
  double sum = 0;  // the sum is scaled, because squares may leave the range of double
  for (const double d : distances) sum += (d / largest) * (d / largest);
  return largest * std::sqrt(sum / static_cast<double>(distances.size() + 1));
}

std::vector<double> distance_to_measure(PointsView points, Index neighbours, PointDistance distance,
                                        double p, const RunContext& context) {
  detail::check_neighbours(neighbours, points.rows());
  std::vector<double> result(static_cast<std::size_t>(points.rows()));
  const auto use = [&](Index row, std::span<const double> nearest) {
    result[static_cast<std::size_t>(row)] = detail::root_mean_square(nearest);
  };
  detail::for_each_nearest(points, neighbours - 1, distance, p, "distance to measure", use,
                           context);
  return result;
}

void detail::check_core_neighbours(Index neighbours, Index size) {
  if (neighbours < 0 || (neighbours > 0 && neighbours >= size)) {
    throw Error(ErrorKind::usage, fmt::format("core neighbours: found {}, expected 0 to the number "
                                              "of other points, {}",
                                              neighbours, std::max<Index>(size - 1, 0)));
  }
}

std::vector<double> core_distances(PointsView points, Index neighbours, PointDistance distance,
                                   double p, const RunContext& context) {
  detail::check_core_neighbours(neighbours, points.rows());
  std::vector<double> result(static_cast<std::size_t>(points.rows()));
  if (neighbours == 0) {
    static_cast<void>(PointMetric(points, distance, p));  // bad points are refused for every k
    return result;
  }
  const auto use = [&](Index row, std::span<const double> nearest) {
    result[static_cast<std::size_t>(row)] = nearest.back();
  };
  detail::for_each_nearest(points, neighbours, distance, p, "core distances", use, context);
  return result;
}

}  // namespace ph
