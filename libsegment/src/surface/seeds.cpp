// SPDX-License-Identifier: MIT
#include "libsegment/src/surface/seeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "ph/barcode.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

/// The adjacent voxels of each voxel, with the cost of the step.
class Steps {
 public:
  struct Step {
    std::uint32_t to;
    double cost;
  };
  Steps(std::size_t size, const std::vector<WeightedEdge>& edges,
        const std::vector<double>& concavity)
      : begin_(size + 1), steps_(2 * edges.size()) {
    // A step through a seam of concavity 0.25, as between boxes on a table, costs eleven times its
    // length.
    constexpr double cost_of_concavity = 40;
    for (const WeightedEdge& e : edges)
      for (const Index v : {e.u, e.v}) ++begin_[static_cast<std::size_t>(v)];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    for (const WeightedEdge& e : edges) {
      const auto u = static_cast<std::size_t>(e.u), v = static_cast<std::size_t>(e.v);
      const double cost = e.value * (1 + cost_of_concavity * std::max(concavity[u], concavity[v]));
      steps_[--begin_[u]] = {static_cast<std::uint32_t>(v), cost};
      steps_[--begin_[v]] = {static_cast<std::uint32_t>(u), cost};
    }
  }
  auto of(std::uint32_t v) const {
    return std::ranges::subrange(steps_.begin() + begin_[v], steps_.begin() + begin_[v + 1]);
  }

 private:
  std::vector<std::ptrdiff_t> begin_;  // for each vertex, the index into steps_
  std::vector<Step> steps_;
};

/// Points in cubes, so that a search near a place need not look at all points.
class Cubes {
 public:
  Cubes(const Points& points, double edge) : points_(points), edge_(edge) {
    for (Index i = 0; i < points.rows(); ++i)
      cubes_[cube_of(i)].push_back(static_cast<std::uint32_t>(i));
  }
  /// Visits at least the points that are nearer to point `i` than `radius`.
  template <class Visit>
  void for_each_near(std::uint32_t i, double radius, Visit&& visit) const {
    const double reach = std::ceil(radius / edge_);
    // All points are visited if the search would look at as many rows of cubes as there are cubes.
    // An infinite radius makes the comparison false, and all points are then also visited.
    if (!(std::pow(2 * reach + 1, 2) < static_cast<double>(cubes_.size()))) {
      for (std::uint32_t k = 0; k < points_.rows(); ++k) visit(k);
      return;
    }
    const Cube middle = cube_of(i);
    for (double z = -reach; z <= reach; ++z) {
      // Cubes along x follow one another in the map.
      for (double y = -reach; y <= reach; ++y) {
        const Cube first{middle[0] + z, middle[1] + y, middle[2] - reach};
        for (auto at = cubes_.lower_bound(first); at != cubes_.end(); ++at) {
          if (at->first[0] != first[0] || at->first[1] != first[1] ||
              at->first[2] > middle[2] + reach)
            break;
          for (const std::uint32_t k : at->second) visit(k);
        }
      }
    }
  }

 private:
  using Cube = std::array<double, 3>;  // the coordinates in the order z, y, x
  Cube cube_of(Index i) const {
    return {std::floor(points_(i, 2) / edge_), std::floor(points_(i, 1) / edge_),
            std::floor(points_(i, 0) / edge_)};
  }

  const Points& points_;
  double edge_;
  std::map<Cube, std::vector<std::uint32_t>> cubes_;
};

/// Chooses seeds by the greedy permutation of the points (Gonzalez 1985) until each point has a
/// seed within `spacing`. Each step takes the point that is farthest from all seeds. If there are
/// several such points, it takes the first of them. A point can get the new seed as its nearest
/// seed only if it is nearer to the new seed than the new seed was to its own nearest seed.
std::vector<std::uint32_t> spread_seeds(const Points& points, double spacing,
                                        const RunContext& context) {
  const auto size = static_cast<std::size_t>(points.rows());
  const Cubes cubes(points, spacing);
  const auto all_points = as_matrix(points);
  std::vector<double> nearest(size, kInfinity);
  struct Farthest {
    double distance;
    std::uint32_t point;
    bool operator<(const Farthest& other) const {
      return distance != other.distance ? distance < other.distance : point > other.point;
    }
  };
  std::vector<Farthest> all;
  for (std::uint32_t i = 0; i < size; ++i) all.push_back({kInfinity, i});
  std::priority_queue<Farthest> queue(std::less<Farthest>(), std::move(all));
  std::vector<std::uint32_t> seeds;
  Ticker ticker(context, "seeds");
  while (queue.top().distance > spacing) {
    const Farthest next = queue.top();
    if (nearest[next.point] < next.distance) {  // the entry is out of date
      queue.pop();
      queue.push({nearest[next.point], next.point});
      continue;
    }
    seeds.push_back(next.point);
    cubes.for_each_near(next.point, next.distance, [&](std::uint32_t k) {
      ticker.work();
      if (nearest[k] > 0)
        nearest[k] = std::min(nearest[k], (all_points.row(k) - all_points.row(next.point)).norm());
    });
    ticker.tick();
  }
  return seeds;
}

}  // namespace

std::vector<double> distance_to_seeds(const Points& centroids,
                                      const std::vector<WeightedEdge>& edges,
                                      const std::vector<double>& concavity, double spacing,
                                      const RunContext& context) {
  const auto size = static_cast<std::size_t>(centroids.rows());
  std::vector<double> distances(size, kInfinity);
  if (size == 0) return distances;
  const Steps steps(size, edges, concavity);

  using Reached = std::pair<double, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t v, double distance) {
    if (distance >= distances[v]) return;
    distances[v] = distance;
    queue.push({distance, v});
  };
  Ticker ticker(context, "distance to seeds", size);
  const auto spread = [&] {  // this is Dijkstra's algorithm
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > distances[v]) continue;
      for (const auto& step : steps.of(v)) reach(step.to, distance + step.cost);
      ticker.tick();
    }
  };
  for (const std::uint32_t seed : spread_seeds(centroids, spacing, context)) reach(seed, 0);
  spread();
  for (std::uint32_t v = 0; v < size; ++v) {
    if (distances[v] < kInfinity) continue;
    reach(v, 0);
    spread();
  }
  return distances;
}

}  // namespace ph::segment
