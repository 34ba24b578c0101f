// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/metric/row_distances.hpp"
#include "ph/detail/metric/spanning_forest.hpp"
#include "ph/detail/rips/binned_edges.hpp"
#include "ph/detail/rips/rips_adjacency.hpp"
#include "ph/detail/rips/vertex_weights.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// The graph under a Vietoris-Rips filtration: all edges up to a threshold, sorted by (distance,
/// larger end, smaller end) as far as needed, and each named by its key, an integer. Keys start at
/// 1; key 0 belongs to the vertices, which enter at 0 or at births of their own. (A collapsed graph
/// orders edges of equal value differently, see edge_collapse.hpp.)
class RipsGraph {
 public:
  using Key = RipsAdjacency::Key;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  /// Evaluates all n(n-1)/2 distances, twice. @throws Error (bad_data) on a negative or NaN
  /// distance.
  /// @param weights the weights of the vertices, here and below; no vertex may enter after the
  /// threshold.
  template <Metric M>
  static RipsGraph of_metric(const M& metric, std::optional<double> threshold,
                             const RunContext& context, const VertexWeights& weights = {});
  /// Uses Euclidean distances up to the threshold, found by for_each_pair_within.
  static RipsGraph of_points_within(PointsView points, double threshold, const RunContext& context,
                                    const VertexWeights& weights = {});
  /// Holds the points and no edges.
  /// @param owner keeps the points; if null, the owner of the graph must keep them.
  static RipsGraph of_points_alone(PointsView points, std::shared_ptr<const Points> owner,
                                   std::optional<double> threshold, const RunContext& context);
  static RipsGraph of_edges(Index size, std::span<const WeightedEdge> edges,
                            std::optional<double> threshold, const RunContext& context,
                            const VertexWeights& weights = {});

  /// A graph with the vertices, names, births and threshold of `graph`, but with other edges.
  /// @param edges by ascending value; ties keep the order given.
  static RipsGraph with_edges(const RipsGraph& graph, FlagEdges&& edges, const RunContext& context);

  /// Holds only a minimum spanning forest, which has the same components as the entire graph at
  /// every distance. Without a threshold there is no limit. Evaluates each distance once, in O(n)
  /// memory.
  template <Metric M>
  static RipsGraph forest_of_metric(const M& metric, std::optional<double> threshold,
                                    const RunContext& context, const VertexWeights& weights = {});
  /// The same forest for points, in near-linear time. Precondition:
  /// has_fast_spanning_forest(points, distance).
  /// @param births the values at which the points enter, with WeightExponent::infinity; if empty,
  /// all points enter at 0.
  static RipsGraph forest_of_points(PointsView points, PointDistance distance, double p,
                                    std::span<const double> births,
                                    std::optional<double> threshold, const RunContext& context);
  /// The same forest with core distances as births, which one search finds together with edges.
  /// @param neighbours 1 to the number of points - 1. Precondition: as for forest_of_points, and at
  /// least one coordinate.
  static RipsGraph core_forest_of_points(PointsView points, Index neighbours,
                                         PointDistance distance, double p,
                                         const RunContext& context);
  /// The same forest for Euclidean points, computed on a GPU. @throws Error (not_built_in,
  /// resource); Error (usage) as gpu::spanning_forest.
  static RipsGraph forest_on_gpu(PointsView points, std::optional<double> threshold,
                                 const RunContext& context);
  static RipsGraph forest_of_edges(Index size, std::span<const WeightedEdge> edges,
                                   std::optional<double> threshold, const RunContext& context,
                                   const VertexWeights& weights = {});

  /// @param forest the result of spanning_forest, in any order.
  static RipsGraph of_forest(Index size, double limit, FlagEdges&& forest,
                             const RunContext& context, std::span<const double> births = {});

  /// @throws Error (resource) if there are too many points for a Rips filtration.
  static void check_size(Index size);
  /// Checks arguments before any point or distance is read, whatever form will be made.
  /// @throws Error (resource, usage) on too many points, or a threshold that is negative or NaN.
  static void check_arguments(Index size, std::optional<double> threshold);
  /// @return the distance, with -0 turned into 0. @throws Error (bad_data) on a negative or NaN
  /// distance.
  static double checked_distance(Index i, Index j, double value);

  Index size() const { return size_; }
  /// The point that vertex v stands for: v itself unless the vertices were named.
  Index name(std::uint32_t v) const { return names_.empty() ? Index{v} : Index{names_[v]}; }
  /// True if the vertices were named. This holds even without vertices, if all points of the input
  /// are left out.
  bool has_names() const { return has_names_; }
  /// Sets the points that the vertices stand for; existing names are translated.
  /// @param points ascending.
  void name_vertices(std::span<const std::uint32_t> points, const RunContext& context);
  /// The values at which the vertices enter; empty if all enter at 0.
  std::span<const double> births() const { return births_; }
  double birth(std::uint32_t v) const { return births_.empty() ? 0.0 : births_[v]; }
  std::size_t edge_count() const { return edges_.size(); }
  /// True if only a spanning forest is held.
  bool is_forest() const { return is_forest_; }
  /// The points if nothing else is held, otherwise null.
  const PointsView* points_alone() const { return points_ ? &points_->view : nullptr; }
  double threshold() const { return threshold_; }

  const FlagEdge& edge(Key key) const { return edges_[key - 1]; }
  /// The value of an edge.
  double value(Key key) const { return edges_[key - 1].value; }
  /// All edges, in order.
  std::span<const FlagEdge> edges() const { return binned_edges().sorted(); }
  /// The edges, for callers that may not need all of them in order. @throws Error (usage) if only
  /// points are held; so do the other members that need edges.
  const BinnedEdges& binned_edges() const {
    require_edges();
    return edges_;
  }
  /// The memory in which edges are allocated.
  std::pmr::memory_resource* memory() const { return names_.get_allocator().resource(); }

  /// True if at least a quarter of the pairs are edges: adjacency() then has the dense layout.
  bool is_dense() const {
    return RipsAdjacency::is_dense(static_cast<std::size_t>(size_), edge_count());
  }
  /// The neighbours of each vertex. They are made at the first call, because engines that work edge
  /// by edge do not need them.
  const RipsAdjacency& adjacency() const {
    if (const RipsAdjacency* made = lazy_->made.load(std::memory_order_acquire)) return *made;
    require_edges();
    const std::lock_guard lock(lazy_->mutex);
    if (const RipsAdjacency* made = lazy_->made.load(std::memory_order_relaxed)) return *made;
    const RipsAdjacency& made =
        lazy_->adjacency.emplace(static_cast<std::size_t>(size_), edges_.sorted(), memory());
    lazy_->made.store(&made, std::memory_order_release);
    return made;
  }

 private:
  // std::call_once is not used: when memory has run out, an exception that passes through it ends
  // the process, because glibc then loads the library that it needs for unwinding.
  struct Lazy {
    std::mutex mutex;
    std::optional<RipsAdjacency> adjacency;
    std::atomic<const RipsAdjacency*> made{nullptr};
  };
  RipsGraph(Index size, double threshold, BinnedEdges&& edges, const RunContext& context,
            std::span<const double> births = {});
  struct PointsAlone {
    PointsView view;
    std::shared_ptr<const Points> owner;
  };
  void require_edges() const {
    if (points_) throw_no_edges();
  }
  [[noreturn]] static void throw_no_edges();
  /// Splits the rows of a triangle into ranges of about equally many pairs. @return the row at
  /// which range r begins.
  static Index range_begin(Index rows, std::size_t r, std::size_t ranges);
  /// The number of ranges: enough to keep the threads busy.
  static std::size_t range_count(Index rows, const RunContext& context);

  Index size_ = 0;
  double threshold_ = 0;
  bool is_forest_ = false;
  bool has_names_ = false;
  std::optional<PointsAlone> points_;      // empty if the edges are held
  BinnedEdges edges_;                      // by key - 1
  std::pmr::vector<std::uint32_t> names_;  // by vertex; if empty, a vertex has its own number
  std::pmr::vector<double> births_;        // by vertex; if empty, all births are 0
  std::unique_ptr<Lazy> lazy_ = std::make_unique<Lazy>();
};

template <Metric M>
RipsGraph RipsGraph::forest_of_metric(const M& metric, std::optional<double> threshold,
                                      const RunContext& context, const VertexWeights& weights) {
  const Index n = metric.size();
  check_arguments(n, threshold);
  const double limit = threshold.value_or(kNoLimit);
  const auto value_of = [&](Index i, Index j) {
    return weights.edge_value(i, j, checked_distance(i, j, metric(i, j)));
  };
  return of_forest(n, limit, spanning_forest(n, value_of, limit, context), context,
                   weights.births());
}

template <Metric M>
RipsGraph RipsGraph::of_metric(const M& metric, std::optional<double> threshold,
                               const RunContext& context, const VertexWeights& weights) {
  const Index n = metric.size();
  check_arguments(n, threshold);
  // The first pass finds the enclosing radius and the distribution of the distances, and the second
  // pass keeps the distances up to the limit. Each distance is evaluated twice instead of being
  // stored.
  const RowDistances<M> distances(metric, &context.memory);
  const std::size_t ranges = range_count(n, context);
  const bool is_weighted = !weights.births().empty();
  using Row = std::pmr::vector<double>;
  const auto for_each_row = [&](std::string_view stage, auto&& use_range) {
    for_each_piece(stage, ranges, 1, context, [&](std::size_t range, std::size_t) {
      std::optional<Ticker> ticker;  // counts the work of the only range
      if (ranges == 1) ticker.emplace(context, stage, static_cast<std::uint64_t>(n));
      Row row(static_cast<std::size_t>(distances.row_capacity()), 0.0, &context.memory);
      const Index end = range_begin(n, range + 1, ranges);
      use_range(range, [&](auto&& use) {
        for (Index i = range_begin(n, range, ranges); i < end; ++i) {
          distances(i, row.data());
          if (is_weighted)
            for (Index j = 0; j < i; ++j)
              row[static_cast<std::size_t>(j)] = weights.edge_value(
                  i, j, checked_distance(i, j, row[static_cast<std::size_t>(j)]));
          use(i, row.data());
          if (!ticker) {
            context.poll();
            continue;
          }
          ticker->tick();
          ticker->work(static_cast<std::uint64_t>(i));
        }
      });
    });
  };
  EdgeBinner binner(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) / 2, ranges, context);
  Row farthest(static_cast<std::size_t>(n), 0.0, &context.memory);
  std::ranges::copy(weights.births(), farthest.begin());  // mutant: weights-enclosing
  std::mutex farthest_mutex;
  for_each_row("enclosing radius", [&](std::size_t range, auto&& for_each) {
    Row of_range(farthest.size(), 0.0, &context.memory);
    for_each([&](Index i, double* row) {
      const double largest = take_maxima(row, i, of_range.data());
      if (std::isnan(largest))
        for (Index j = 0; j < i; ++j) checked_distance(i, j, row[j]);
      double& of_row = of_range[static_cast<std::size_t>(i)];
      of_row = std::max(of_row, largest);
      for (Index j = 0; j < i; ++j) binner.count(row[j], range);
    });
    const std::lock_guard lock(farthest_mutex);
    for (std::size_t i = 0; i < farthest.size(); ++i)
      farthest[i] = std::max(farthest[i], of_range[i]);
  });
  const double radius = n == 0 ? kNoLimit : *std::ranges::min_element(farthest);
  const double limit = threshold.value_or(radius);  // mutant: rips-enclosing
  // An infinite distance is not an edge.
  const double last = std::min(limit, std::numeric_limits<double>::max());
  binner.allocate(last);
  for_each_row("edges", [&](std::size_t range, auto&& for_each) {
    for_each([&](Index i, const double* row) {
      for (Index j = 0; j < i; ++j)
        if (row[j] <= last)  // mutant: rips-threshold
          binner.add({row[j] + 0.0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)},
                     range);
    });
  });
  return RipsGraph(n, limit, binner.finish(), context, weights.births());
}

}  // namespace ph
