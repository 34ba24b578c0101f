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
/// 2013), with the growth of balls of Cavanna, Jahanseir and Sheehy (A geometric perspective on
/// sparse filtrations, 2015): each ball stops growing at a size in proportion to the insertion
/// radius of its point in a greedy permutation, and edges enter when balls meet. Edges that come
/// after the smaller ball lies well within others are left out. A flag complex: no simplex but by
/// its edges.
///
/// If the triangle inequality holds, its barcode and that of the Rips filtration can be matched
/// such that here bars are born and die at the same value or later, by a factor of 1 + epsilon at
/// most; only bars [b, d) with d <= (1 + epsilon) b, of either, are left unmatched. Proof:
/// docs/explanation/approximation.md.
class SparseRips {
 public:
  /// @throws Error (usage) unless it is a finite number above 0.
  static void check_epsilon(double epsilon);
  /// @param order of all points (GreedyLimits{}). @param size number of points.
  /// @param epsilon as check_epsilon wants it.
  SparseRips(const GreedyPermutation& order, Index size, double epsilon, const RunContext& context);

  /// When two points at a distance are joined; infinite: never.
  double edge_value(Index u, Index v, double distance) const {
    const double of_u = largest_ball(u), of_v = largest_ball(v), small = std::min(of_u, of_v);
    const double value = meeting(small, std::max(of_u, of_v), distance);
    return value <= (1 + epsilon_) * small ? value : RipsGraph::kNoLimit;
  }
  /// From here on there is one component and nothing else: point 0, whose ball grows for ever, has
  /// met all others.
  double reach(Index v, double distance) const {
    return meeting(largest_ball(v), RipsGraph::kNoLimit, distance);
  }

 private:
  double largest_ball(Index v) const { return largest_ball_[static_cast<std::size_t>(v)]; }
  /// Of balls of such largest diameters.
  static double meeting(double small, double large, double distance) {
    if (distance <= small) return distance;
    const double value = distance + (distance - small);
    return value <= large ? value : RipsGraph::kNoLimit;
  }

  double epsilon_;
  std::pmr::vector<double> largest_ball_;  // by point: its diameter
};

/// The graph of the sparse Rips filtration. Evaluates all distances once beside those of the
/// permutation; keeps O(n / epsilon^d) edges for points of a space of d dimensions whose diameter
/// is not too many times their least distance.
/// @param threshold default: where nothing but one component is left.
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
