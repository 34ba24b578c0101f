// SPDX-License-Identifier: MIT
#include "ph/detail/metric/pairs_within.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "libph/src/metric/cube_list.hpp"
#include "libph/src/metric/neighbour_search.hpp"
#include "libph/src/metric/plain_squares.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using Visit = std::function<void(Index, Index, double)>;

// The points and the radius of a search for pairs. Both are multiplied by a power of two if squares
// would leave the range of double. This is exact, except for digits that are negligible compared
// with the largest coordinate.
struct SearchSpace {
  PointsView points;
  double radius;
  bool is_scaled;
};

void visit_in_cubes(const SearchSpace& space, const PointMetric& metric, double radius,
                    const Visit& visit, const RunContext& context) {
  const CubeList cubes(space.points, space.radius, context);
  // Most candidates are so far apart that comparing squares is enough, despite rounding errors.
  // These candidates need no root.
  const double far =
      std::max(space.radius * space.radius, PointMetric::kLeastPlainSquare) * (1 + 1e-12);
  cubes.for_each_candidate_pair(
      [&](const CubeList::Point& p, const CubeList::Point& q) {
        const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
        const double square = dx * dx + dy * dy + dz * dz;
        if (square > far) return;
        // The sum equals the metric's sum, unless digits were lost to underflow.
        const double d = square >= PointMetric::kLeastPlainSquare && !space.is_scaled
                             ? std::sqrt(square)
                             : metric(p.number, q.number);
        // mutant: cubes-radius
        if (d <= radius) visit(std::min(p.number, q.number), std::max(p.number, q.number), d);
      },
      context);
}

void visit_by_cubes(const PointMetric& metric, double radius, const Visit& visit,
                    const RunContext& context) {
  const PointsView points = metric.points();
  const double reach = largest_coordinate(points);
  if (reach == 0 || (kSmallestPlain < reach && reach < kLargestPlain)) {
    visit_in_cubes({points, std::min(radius, kLargestPlain), false}, metric, radius, visit,
                   context);
    return;
  }
  const int exponent = -std::ilogb(reach);
  const auto scale = [=](double x) { return std::scalbn(x, exponent); };
  Points scaled(points);
  std::ranges::transform(scaled.coordinates(), scaled.data(), scale);
  // A distance that is itself denormal may be rounded by up to half of the smallest denormal.
  const double reachable = radius + std::numeric_limits<double>::denorm_min();
  visit_in_cubes({scaled, std::min(scale(reachable), kLargestPlain), true}, metric, radius, visit,
                 context);
}

void visit_by_tree(const PointMetric& metric, double radius, const Visit& visit,
                   const RunContext& context) {
  std::pmr::vector<std::uint32_t> rows(static_cast<std::size_t>(metric.size()), &context.memory);
  std::iota(rows.begin(), rows.end(), 0U);
  const KdTree tree(metric.points(), rows, context);
  const PointMetric of_tree(tree.points());
  NeighbourSearch::make(tree, of_tree, PointDistance::euclidean, 2, nullptr, context)
      ->pairs_within(radius, visit, context);
}

}  // namespace

void for_each_pair_within(PointsView points, double radius, const Visit& visit,
                          const RunContext& context) {
  if (!(radius >= 0)) {
    throw Error(ErrorKind::usage, fmt::format("radius: found {}, expected a number >= 0", radius));
  }
  const PointMetric metric(points);
  if (points.rows() == 0) return;
  // The squares of smaller distances may lose digits to underflow, and all points at smaller
  // distances would be in one cube.
  constexpr double tiny = 1e-139;
  const bool has_cubes = points.cols() == 0 || (points.cols() <= 3 && radius >= tiny);
  const auto visit_all = has_cubes ? visit_by_cubes : visit_by_tree;
  visit_all(metric, radius, visit, context);
}

}  // namespace ph
