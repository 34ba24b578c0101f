// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"
#include "ph/metric/metric.hpp"
#include "ph/metric/sparse_distances.hpp"

namespace ph {

/// The graph under a Vietoris-Rips filtration: all edges up to a threshold, sorted once by
/// (distance, larger end, smaller end) and from then on known by their key, an integer. Keys start
/// at 1; key 0 belongs to the vertices, which enter at 0.
///
/// Two layouts: a square matrix of keys where most pairs are edges, sorted neighbour lists where
/// they are not.
class RipsGraph {
 public:
  using Key = std::uint32_t;
  static constexpr Key kNever = UINT32_MAX;  ///< no edge
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  using Edge = FlagEdge;
  struct Neighbour {
    std::uint32_t vertex;
    Key key;
  };

  /// Evaluates all n(n-1)/2 distances. @throws Error (bad_data) on a negative or NaN distance.
  template <Metric M>
  static RipsGraph of_metric(const M& metric, std::optional<double> threshold,
                             const RunContext& context);
  /// Euclidean distances up to the threshold; never n^2 of them.
  static RipsGraph of_points_within(const Points& points, double threshold,
                                    const RunContext& context);
  static RipsGraph of_edges(Index size, std::span<const WeightedEdge> edges,
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
  double threshold() const { return threshold_; }
  bool is_dense() const { return !matrix_.empty(); }

  Edge edge(Key key) const { return edges_[key - 1]; }
  double value(Key key) const { return key == 0 ? 0.0 : values_[key - 1]; }
  std::span<const Edge> edges() const { return edges_; }

  /// Dense layout: the keys of all pairs with u; kNever at u itself.
  const Key* row(std::uint32_t u) const {
    return matrix_.data() + std::size_t{u} * static_cast<std::size_t>(size_);
  }
  /// Sparse layout: the neighbours of u, ascending.
  std::span<const Neighbour> neighbours(std::uint32_t u) const {
    return std::span(neighbours_).subspan(offsets_[u], offsets_[u + 1] - offsets_[u]);
  }
  Key key_of(std::uint32_t u, std::uint32_t v) const {
    if (is_dense()) return row(u)[v];
    const auto list = neighbours(u);
    const auto it = std::ranges::lower_bound(list, v, {}, &Neighbour::vertex);
    return it != list.end() && it->vertex == v ? it->key : kNever;
  }
  /// No clique has more vertices than this: one more than the degeneracy of the graph, or its size.
  Index clique_bound() const { return clique_bound_; }

 private:
  struct Candidate {
    double value;
    Edge edge;
  };
  explicit RipsGraph(std::pmr::memory_resource* memory)
      : edges_(memory),
        values_(memory),
        matrix_(memory),
        offsets_(memory),
        neighbours_(memory),
        names_(memory) {}
  static void check_arguments(Index size, std::optional<double> threshold);
  static void check_distance(Index i, Index j, double value);
  /// Sorts the candidates, all <= threshold, and lays the graph out.
  static RipsGraph build(Index size, double threshold, std::pmr::vector<Candidate>&& candidates,
                         const RunContext& context);
  void lay_out_dense();
  void lay_out_sparse();
  Index degeneracy_bound() const;

  Index size_ = 0;
  Index clique_bound_ = 0;
  double threshold_ = 0;
  std::pmr::vector<Edge> edges_;     // by key - 1
  std::pmr::vector<double> values_;  // by key - 1
  std::pmr::vector<Key> matrix_;     // dense layout
  std::pmr::vector<std::size_t> offsets_;
  std::pmr::vector<Neighbour> neighbours_;
  std::pmr::vector<std::uint32_t> names_;  // by vertex; empty: its number
};

template <Metric M>
RipsGraph RipsGraph::of_metric(const M& metric, std::optional<double> threshold,
                               const RunContext& context) {
  const Index n = metric.size();
  check_arguments(n, threshold);
  // One pass finds the enclosing radius, the next one keeps what lies within it: distances are
  // evaluated twice rather than all stored.
  double limit = threshold.value_or(kNoLimit);
  if (!threshold && n > 0) {
    Ticker ticker(context, "enclosing radius", static_cast<std::uint64_t>(n));
    for (Index i = 0; i < n; ++i) {
      double farthest = 0;
      for (Index j = 0; j < n && farthest < limit; ++j)
        farthest = std::max(farthest, static_cast<double>(metric(i, j)));
      limit = std::min(limit, farthest);
      ticker.tick();
      ticker.work(static_cast<std::uint64_t>(n));
    }
  }
  std::pmr::vector<Candidate> candidates(&context.memory);
  Ticker ticker(context, "edges", static_cast<std::uint64_t>(n));
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) {
      const double d = metric(i, j) + 0.0;  // -0.0 becomes +0.0
      if (!(d >= 0)) check_distance(i, j, d);
      if (d <= limit && d < kNoLimit) {
        candidates.push_back({d, {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)}});
      }
    }
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(i));
  }
  return build(n, limit, std::move(candidates), context);
}

}  // namespace ph
