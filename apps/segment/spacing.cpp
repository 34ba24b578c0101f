// SPDX-License-Identifier: MIT
#include "spacing.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "ph/core/barcode.hpp"
#include "ph/metric/greedy_permutation.hpp"

namespace ph::segment {
namespace {

/// Who is adjacent to whom, and at what cost.
class Steps {
 public:
  struct Step {
    std::uint32_t to;
    double cost;
  };
  Steps(std::size_t size, const std::vector<WeightedEdge>& edges,
        const std::vector<double>& concavity)
      : begin_(size + 1), steps_(2 * edges.size()) {
    // A seam of 0.25, as between boxes on a table, is as far as ten times its width.
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
  std::vector<std::ptrdiff_t> begin_;  // by vertex, into steps_
  std::vector<Step> steps_;
};

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
  const auto spread = [&] {  // Dijkstra's algorithm
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > distances[v]) continue;
      for (const auto& step : steps.of(v)) reach(step.to, distance + step.cost);
      ticker.tick();
    }
  };
  GreedyLimits limits;
  limits.radius = spacing;
  const GreedyPermutation seeds =
      greedy_permutation(centroids, limits, PointDistance::euclidean, 2, context);
  for (const std::uint32_t seed : seeds.points) reach(seed, 0);
  spread();
  for (std::uint32_t v = 0; v < size; ++v) {
    if (distances[v] < kInfinity) continue;
    reach(v, 0);
    spread();
  }
  return distances;
}

}  // namespace ph::segment
