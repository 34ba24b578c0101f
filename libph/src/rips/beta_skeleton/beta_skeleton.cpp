// SPDX-License-Identifier: MIT
#include "libph/src/rips/beta_skeleton/beta_skeleton.hpp"

#include <iterator>
#include <random>

namespace ph {
namespace {

// These limits were measured (see docs/explanation/engines/beta-skeleton.md). With fewer points,
// listing all edges is faster. In R^4, the limit is determined by the memory that the edges take.
// The limits are indexed by the number of coordinates.
constexpr Index kFewestPoints[] = {0, 1'000, 3'000, 15'000, 40'000};
// With fewer edges per point than this, listing the edges is faster.
constexpr double kFewEdges = 1'000;

/// The approximate number of edges per point, from a sample of pairs.
double edges_of_a_point(PointsView points, double threshold) {
  constexpr int sampled = 2'000;
  std::mt19937_64 random(1);
  const auto pick = [&] {
    return static_cast<Index>(random() % static_cast<std::uint64_t>(points.rows()));
  };
  int within = 0;
  for (int i = 0; i < sampled; ++i) {
    const Index p = pick(), q = pick();
    double square = 0;
    for (Index k = 0; k < points.cols(); ++k)
      square += (points(p, k) - points(q, k)) * (points(p, k) - points(q, k));
    within += square <= threshold * threshold ? 1 : 0;
  }
  return within / double{sampled} * static_cast<double>(points.rows()) / 2;
}

}  // namespace

std::string_view BetaSkeletonEngine::obstacle(const Task& task) {
  if (task.max_dim > 1) return "dimensions 0 and 1 only";
  if (task.representatives != Representatives::none) return "bars without representatives";
  if (task.zero_length) return "bars of positive length";
  if (task.collapses) return "a task without an edge collapse";
  return {};
}

std::string_view BetaSkeletonEngine::obstacle(const RipsInput& input, const Task& task) {
  if (const std::string_view of_task = obstacle(task); !of_task.empty()) return of_task;
  const RipsOptions& options = input.options;
  if (!input.points) return "points";
  if (options.distance != PointDistance::euclidean) return "the Euclidean distance";
  if (input.points->cols() < 1 || input.points->cols() > kMostPointCoordinates)
    return "points of 1 to 4 coordinates";
  if (!options.births.empty() || options.computes_births()) return "vertices that all enter at 0";
  if (options.approximation) return "the full filtration, not a sparse one";
  if (!has_plain_coordinates(*input.points))
    return "coordinates that are 0 or between 1e-120 and 1e150 in absolute value";
  return {};
}

Suitability BetaSkeletonEngine::suitability(const RipsInput& input, const Task& task) {
  const bool pays = task.max_dim == 1 && input.size >= kFewestPoints[input.points->cols()] &&
                    (!input.options.threshold ||
                     edges_of_a_point(*input.points, *input.options.threshold) > kFewEdges);
  return pays ? kSuits : Suitability{};
}

}  // namespace ph
