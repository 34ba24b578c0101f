// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <vector>

#include "ph/detail/metric/metric.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Sparse Rips filtrations (Sheehy, Linear-size approximations to the Vietoris-Rips filtration,
/// 2013), with balls that grow as in Cavanna, Jahanseir and Sheehy (A geometric perspective on
/// sparse filtrations, 2015). Each ball stops growing at a size that is proportional to the
/// insertion radius of its point in a greedy permutation; an edge enters when its two balls meet.
/// Edges that would enter after the smaller ball lies well inside other balls are left out. The
/// result is a flag complex: the edges determine all simplices.
///
/// If the triangle inequality holds, the bars can be matched with the bars of the Rips filtration
/// such that each bar of the sparse filtration is born and dies no earlier than its partner, and
/// later by a factor of at most 1 + epsilon; only bars [b, d) with d <= (1 + epsilon) b, of either
/// filtration, are left unmatched. For a proof see docs/explanation/approximation.md.
class SparseRips {
 public:
  /// @throws Error (usage) unless `epsilon` is a finite number above 0.
  static void check_epsilon(double epsilon);
  /// @param order a greedy permutation of all points, made with GreedyLimits{}. @param size number
  /// of points.
  /// @param epsilon must satisfy check_epsilon.
  SparseRips(const GreedyPermutation& order, Index size, double epsilon, const RunContext& context);

  /// The value at which two points at a distance are joined, or infinity if they never are.
  double edge_value(Index u, Index v, double distance) const {
    const double of_u = largest_ball(u), of_v = largest_ball(v), small = std::min(of_u, of_v);
    const double value = meeting(small, std::max(of_u, of_v), distance);
    return value <= (1 + epsilon_) * small ? value : RipsGraph::kNoLimit;  // mutant: sparse-gone
  }
  /// The value at which the ball of v meets the ball of point 0, which grows forever. At and above
  /// the largest of these values, the complex has a single component and no other homology.
  double reach(Index v, double distance) const {
    return meeting(largest_ball(v), RipsGraph::kNoLimit, distance);
  }

 private:
  double largest_ball(Index v) const { return largest_ball_[static_cast<std::size_t>(v)]; }
  /// The value at which two balls with these largest diameters meet.
  static double meeting(double small, double large, double distance) {
    if (distance <= small) return distance;
    const double value = distance + (distance - small);  // mutant: sparse-value
    return value <= large ? value : RipsGraph::kNoLimit;
  }

  double epsilon_;
  std::pmr::vector<double> largest_ball_;  // by point: the largest diameter of its ball
};

/// The graph of the sparse Rips filtration. Evaluates all distances once, in addition to the
/// distances for the permutation. Keeps O(n / epsilon^d) edges for points in d dimensions, if the
/// diameter is not too large a multiple of the least distance.
/// @param threshold by default, the least value at which only one component is left.
template <Metric M>
RipsGraph sparse_rips_graph(const M& metric, const GreedyPermutation& order, double epsilon,
                            std::optional<double> threshold, const RunContext& context) {
  const Index n = metric.size();
  const SparseRips sparse(order, n, epsilon, context);
  double limit = threshold.value_or(0);
  for (Index v = 1; !threshold && v < n; ++v)
    limit = std::max(limit, sparse.reach(v, metric(v, 0)));
  std::pmr::vector<WeightedEdge> edges(&context.memory);
  Ticker ticker(context, "edges", static_cast<std::uint64_t>(n));
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) {
      const double value = sparse.edge_value(i, j, RipsGraph::checked_distance(i, j, metric(i, j)));
      if (value <= limit && value < RipsGraph::kNoLimit) edges.push_back({i, j, value});
    }
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(i));
  }
  return RipsGraph::of_edges(n, edges, limit, context);
}

}  // namespace ph
