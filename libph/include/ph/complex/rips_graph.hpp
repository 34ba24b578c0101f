// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ph/complex/edge_sorter.hpp"
#include "ph/complex/rips_adjacency.hpp"
#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"
#include "ph/metric/metric.hpp"
#include "ph/metric/spanning_forest.hpp"
#include "ph/metric/sparse_distances.hpp"

namespace ph {

/// The graph under a Vietoris-Rips filtration: all edges up to a threshold, sorted once by
/// (distance, larger end, smaller end) and from then on known by their key, an integer. Keys start
/// at 1; key 0 belongs to the vertices, which enter at 0. (A collapsed graph has its own order
/// within a value, see edge_collapse.hpp.)
class RipsGraph {
 public:
  using Key = RipsAdjacency::Key;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  /// Evaluates all n(n-1)/2 distances, twice. @throws Error (bad_data) on a negative or NaN one.
  template <Metric M>
  static RipsGraph of_metric(const M& metric, std::optional<double> threshold,
                             const RunContext& context);
  /// Euclidean distances up to the threshold; never n^2 of them.
  static RipsGraph of_points_within(const Points& points, double threshold,
                                    const RunContext& context);
  static RipsGraph of_edges(Index size, std::span<const WeightedEdge> edges,
                            std::optional<double> threshold, const RunContext& context);

  /// The same vertices, names and threshold with other edges.
  /// @param edges by ascending value; ties come in the order given.
  static RipsGraph with_edges(const RipsGraph& graph, std::pmr::vector<FlagEdge>&& edges,
                              const RunContext& context);

  /// Only a minimum spanning forest, which has the components of the whole graph at every distance.
  /// Without a threshold there is none. Evaluates each distance once and keeps O(n) memory.
  template <Metric M>
  static RipsGraph forest_of_metric(const M& metric, std::optional<double> threshold,
                                    const RunContext& context);
  /// The same in near-linear time. Precondition: has_fast_spanning_forest(points, distance).
  static RipsGraph forest_of_points(const Points& points, PointDistance distance, double p,
                                    std::optional<double> threshold, const RunContext& context);
  static RipsGraph forest_of_edges(Index size, std::span<const WeightedEdge> edges,
                                   std::optional<double> threshold, const RunContext& context);

  /// @throws Error (resource) if there are too many points for a Rips filtration.
  static void check_size(Index size);

  Index size() const { return size_; }
  /// The point that vertex v stands for: v itself unless the vertices were named.
  Index name(std::uint32_t v) const { return names_.empty() ? Index{v} : Index{names_[v]}; }
  bool has_names() const { return !names_.empty(); }
  /// @param names one a vertex, ascending.
  void name_vertices(std::pmr::vector<std::uint32_t> names) { names_ = std::move(names); }
  std::size_t edge_count() const { return edges_.size(); }
  /// Whether only a spanning forest is held.
  bool is_forest() const { return is_forest_; }
  double threshold() const { return threshold_; }

  const FlagEdge& edge(Key key) const { return edges_[key - 1]; }
  double value(Key key) const { return key == 0 ? 0.0 : edges_[key - 1].value; }
  std::span<const FlagEdge> edges() const { return edges_; }

  /// Whether most pairs are edges: the layout that adjacency() has, or will have.
  bool is_dense() const {
    return RipsAdjacency::is_dense(static_cast<std::size_t>(size_), edge_count());
  }
  /// Made when it is first asked for, by whichever thread comes first: engines that go edge by edge
  /// do without.
  const RipsAdjacency& adjacency() const {
    if (const RipsAdjacency* made = lazy_->made.load(std::memory_order_acquire)) return *made;
    const std::lock_guard lock(lazy_->mutex);
    if (!lazy_->adjacency) {
      lazy_->adjacency.emplace(static_cast<std::size_t>(size_), edges_,
                               edges_.get_allocator().resource());
      lazy_->made.store(&*lazy_->adjacency, std::memory_order_release);
    }
    return *lazy_->adjacency;
  }

 private:
  // Not std::call_once: an exception that passes it ends the process where memory has run out,
  // since glibc then loads what it needs to unwind.
  struct Lazy {
    std::mutex mutex;
    std::optional<RipsAdjacency> adjacency;
    std::atomic<const RipsAdjacency*> made{nullptr};
  };
  /// @param edges sorted.
  RipsGraph(Index size, double threshold, std::pmr::vector<FlagEdge>&& edges,
            const RunContext& context);
  static RipsGraph of_forest(Index size, double limit, std::pmr::vector<FlagEdge>&& forest,
                             const RunContext& context);
  static void check_arguments(Index size, std::optional<double> threshold);
  static double checked_distance(Index i, Index j, double value);

  Index size_ = 0;
  double threshold_ = 0;
  bool is_forest_ = false;
  std::pmr::vector<FlagEdge> edges_;       // by key - 1
  std::pmr::vector<std::uint32_t> names_;  // by vertex; empty: its number
  std::unique_ptr<Lazy> lazy_ = std::make_unique<Lazy>();
};

template <Metric M>
RipsGraph RipsGraph::forest_of_metric(const M& metric, std::optional<double> threshold,
                                      const RunContext& context) {
  const Index n = metric.size();
  check_arguments(n, threshold);
  const double limit = threshold.value_or(kNoLimit);
  const auto distance_of = [&](Index i, Index j) { return checked_distance(i, j, metric(i, j)); };
  return of_forest(n, limit, spanning_forest(n, distance_of, limit, context), context);
}

template <Metric M>
RipsGraph RipsGraph::of_metric(const M& metric, std::optional<double> threshold,
                               const RunContext& context) {
  const Index n = metric.size();
  check_arguments(n, threshold);
  // One pass finds the enclosing radius and how the distances are spread, the next one keeps those
  // within: distances are evaluated twice rather than all stored.
  const auto for_each_distance = [&](std::string_view stage, auto&& use) {
    Ticker ticker(context, stage, static_cast<std::uint64_t>(n));
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < i; ++j) use(i, j, checked_distance(i, j, metric(i, j)));
      ticker.tick();
      ticker.work(static_cast<std::uint64_t>(i));
    }
  };
  EdgeSorter sorter(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) / 2, context);
  std::pmr::vector<double> farthest(static_cast<std::size_t>(n), 0.0, &context.memory);
  for_each_distance("enclosing radius", [&](Index i, Index j, double d) {
    double &of_i = farthest[static_cast<std::size_t>(i)],
           &of_j = farthest[static_cast<std::size_t>(j)];
    of_i = std::max(of_i, d);
    of_j = std::max(of_j, d);
    sorter.count(d);
  });
  const double radius = n == 0 ? kNoLimit : *std::ranges::min_element(farthest);
  const double limit = threshold.value_or(radius);
  const double last = std::min(limit, std::numeric_limits<double>::max());  // infinite: no edge
  sorter.allocate(last);
  for_each_distance("edges", [&](Index i, Index j, double d) {
    if (d <= last) sorter.add({d, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
  });
  return RipsGraph(n, limit, sorter.finish(), context);
}

}  // namespace ph
