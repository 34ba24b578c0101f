// SPDX-License-Identifier: MIT
#include "metric/pairs_within.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "metric/cube_list.hpp"
#include "ph/detail/metric/row_distances.hpp"
#include "ph/error.hpp"
#include "ph/metric.hpp"

namespace ph {
namespace {

// Below this a sum of squares may have lost digits to underflow.
constexpr double kSmallestPlainSquare = 1e-280;
// Coordinates whose differences have squares that neither overflow nor underflow.
constexpr double kSmallestPlain = 1e-140, kLargestPlain = 1e150;

// Where to look for the pairs: the points and the radius, times a power of two where squares would
// leave the range of double. That is exact but for digits that do not count beside the largest
// coordinate.
struct SearchSpace {
  PointsView points;
  double radius;
  bool is_scaled;
};

constexpr std::uint64_t kPollInterval = 1 << 16;

// The view of the points that nanoflann asks for.
struct KdPoints {
  PointsView points;
  const RunContext& context;
  mutable std::uint64_t looks = 0;  // building the tree takes long, and here is where to stop it
  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points.rows()); }
  double kdtree_get_pt(std::size_t i, std::size_t k) const {
    if (++looks % kPollInterval == 0) context.poll();
    return points(static_cast<Index>(i), static_cast<Index>(k));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, KdPoints>, KdPoints>;

using Visit = std::function<void(Index, Index, double)>;

void visit_by_cubes(const SearchSpace& space, const PointMetric& metric, double radius,
                    const Visit& visit, const RunContext& context) {
  const CubeList cubes(space.points, space.radius, context);
  // Most candidates are too far away by more than rounding: no root is needed to see it.
  const double far = std::max(space.radius * space.radius, kSmallestPlainSquare) * (1 + 1e-12);
  cubes.for_each_candidate_pair(
      [&](const CubeList::Point& p, const CubeList::Point& q) {
        const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
        const double square = dx * dx + dy * dy + dz * dz;
        if (square > far) return;
        // The same sum as the metric's, unless digits were lost to underflow.
        const double d = square >= kSmallestPlainSquare && !space.is_scaled
                             ? std::sqrt(square)
                             : metric(p.number, q.number);
        if (d <= radius) visit(std::min(p.number, q.number), std::max(p.number, q.number), d);
      },
      context);
}

void visit_by_tree(const SearchSpace& space, const PointMetric& metric, double radius,
                   const Visit& visit, const RunContext& context) {
  const PointsView points = space.points;
  const KdPoints view{points, context};
  const KdTree tree(static_cast<int>(points.cols()), view, {16});
  // The tree compares squares, which lose digits to underflow: ask for a hair more and let the
  // metric decide.
  const double ask = std::max(space.radius * space.radius, kSmallestPlainSquare) * (1 + 1e-12);
  std::vector<std::pair<std::uint32_t, double>> found;
  Ticker ticker(context, "near pairs", static_cast<std::uint64_t>(points.rows()));
  for (Index i = 0; i < points.rows(); ++i) {
    ticker.tick();
    tree.radiusSearch(points.row(i), ask, found, nanoflann::SearchParams(0, 0, false));
    for (const auto& [j, squared] : found) {
      if (Index{j} <= i) continue;
      if (const double d = metric(i, j); d <= radius) visit(i, j, d);
    }
  }
}

void visit_by_rows(const SearchSpace&, const PointMetric& metric, double radius, const Visit& visit,
                   const RunContext& context) {
  const RowDistances<PointMetric> distances(metric, &context.memory);
  std::pmr::vector<double> row(static_cast<std::size_t>(distances.row_capacity()), 0.0,
                               &context.memory);
  for (Index i = 0; i < metric.size(); ++i) {
    context.poll();
    distances(i, row.data());
    for (Index j = 0; j < i; ++j)
      if (const double d = row[static_cast<std::size_t>(j)]; d <= radius) visit(j, i, d);
  }
}

auto visit_for(PointsView points) {
  // Measured: a tree of so few points takes longer than all pairs, many at a time.
  constexpr Index few = 1 << 14;
  if (points.cols() <= 3) return visit_by_cubes;
  return points.rows() <= few ? visit_by_rows : visit_by_tree;
}

}  // namespace

void for_each_pair_within(PointsView points, double radius, const Visit& visit,
                          const RunContext& context) {
  if (!(radius >= 0)) {
    throw Error(ErrorKind::usage, fmt::format("radius: found {}, expected a number >= 0", radius));
  }
  const PointMetric metric(points);
  points = metric.points();  // whose rows are whole
  const double reach = largest_coordinate(points);
  const auto visit_in = [&](const SearchSpace& space) {
    visit_for(points)(space, metric, radius, visit, context);
  };
  if (reach == 0 || (kSmallestPlain < reach && reach < kLargestPlain)) {
    visit_in({points, std::min(radius, kLargestPlain), false});
  } else {
    const int exponent = -std::ilogb(reach);
    const auto scale = [=](double x) { return std::scalbn(x, exponent); };
    Points scaled(points);
    std::ranges::transform(scaled.coordinates(), scaled.data(), scale);
    // Distances that are denormal themselves were rounded, by half of the least one at most.
    const double reachable = radius + std::numeric_limits<double>::denorm_min();
    visit_in({scaled, std::min(scale(reachable), kLargestPlain), true});
  }
}

}  // namespace ph
