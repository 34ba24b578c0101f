// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "ph/detail/facade/choose_engine.hpp"
#include "ph/error.hpp"
#include "rips/beta_skeleton/points_alone.hpp"

namespace ph {
namespace {

// Measured, see docs/explanation/engines/beta-skeleton.md: below, all edges take less time. In R^4
// it is their memory that decides.
constexpr Index kFewestPoints[] = {0, 1'000, 3'000, 15'000, 40'000};  // by coordinates

/// How many edges there are for each point, about, of a sample of pairs.
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

std::string_view detail::obstacle_to_points_alone(const Options& options, int max_dim) {
  if (max_dim > 1) return "H0 and H1";
  if (options.representatives != Representatives::none) return "bars without representatives";
  if (options.min_persistence < 0) return "bars of positive length";
  if (options.collapse == Collapse::on) return "what needs no edges to collapse";
  return {};
}

bool holds_points_alone(PointsView points, const RipsOptions& rips, const Options& options) {
  if (options.engine != Engine::automatic && options.engine != Engine::beta_skeleton) return false;
  const int max_dim = options.max_dim.value_or(1);
  const std::string_view of_task = detail::obstacle_to_points_alone(options, max_dim);
  if (options.engine == Engine::beta_skeleton) {
    if (!of_task.empty())
      throw Error(ErrorKind::usage,
                  fmt::format("engine {}: expected {}", options.engine.name(), of_task));
    if (const auto obstacle = obstacle_to_points_alone(points, rips); !obstacle.empty())
      throw Error(ErrorKind::usage,
                  fmt::format("engine {}: expected {}", options.engine.name(), obstacle));
    return true;
  }
  const Index vertices =
      rips.vertices.empty() ? points.rows() : static_cast<Index>(rips.vertices.size());
  if (max_dim != 1 || !of_task.empty() || points.cols() < 1 ||
      points.cols() >= static_cast<Index>(std::size(kFewestPoints)) ||
      vertices < kFewestPoints[points.cols()] || !obstacle_to_points_alone(points, rips).empty())
    return false;
  // With few edges they are listed sooner.
  constexpr double many = 1'000;
  return !rips.threshold || edges_of_a_point(points, *rips.threshold) > many;
}

}  // namespace ph
