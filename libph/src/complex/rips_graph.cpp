// SPDX-License-Identifier: MIT
#include "ph/complex/rips_graph.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "ph/core/error.hpp"
#include "ph/core/radix_sort.hpp"
#include "ph/metric/pairs_within.hpp"

namespace ph {

void RipsGraph::check_size(Index size) {
  if (size < 0 || size >= Index{UINT32_MAX}) {
    throw Error(ErrorKind::resource,
                fmt::format("a Rips filtration holds fewer than 2^32 - 1 points, found {}", size));
  }
}

void RipsGraph::check_arguments(Index size, std::optional<double> threshold) {
  check_size(size);
  if (threshold && !(*threshold >= 0)) {
    throw Error(ErrorKind::usage,
                fmt::format("threshold: found {}, expected a number >= 0", *threshold));
  }
}

void RipsGraph::check_distance(Index i, Index j, double value) {
  throw Error(ErrorKind::bad_data,
              fmt::format("distance ({}, {}): found {}, expected a number >= 0", i, j, value));
}

RipsGraph RipsGraph::of_points_within(const Points& points, double threshold,
                                      const RunContext& context) {
  check_arguments(points.rows(), threshold);
  std::pmr::vector<Candidate> candidates(&context.memory);
  Ticker ticker(context, "edges");
  for_each_pair_within(
      points, threshold,
      [&](Index i, Index j, double d) {
        ticker.tick();
        candidates.push_back({d, {static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(i)}});
      },
      context);
  return build(points.rows(), threshold, std::move(candidates), context);
}

RipsGraph RipsGraph::of_edges(Index size, std::span<const WeightedEdge> edges,
                              std::optional<double> threshold, const RunContext& context) {
  check_arguments(size, threshold);
  const double limit = threshold.value_or(kNoLimit);
  std::pmr::vector<Candidate> candidates(&context.memory);
  candidates.reserve(edges.size());
  for (const WeightedEdge& e : edges) {
    if (e.value > limit || e.value == kNoLimit) continue;
    const auto [small, large] = std::minmax(e.u, e.v);
    candidates.push_back(
        {e.value, {static_cast<std::uint32_t>(large), static_cast<std::uint32_t>(small)}});
  }
  return build(size, limit, std::move(candidates), context);
}

RipsGraph RipsGraph::build(Index size, double threshold, std::pmr::vector<Candidate>&& candidates,
                           const RunContext& context) {
  if (candidates.size() >= kNever) {
    throw Error(
        ErrorKind::resource,
        fmt::format("a Rips filtration holds fewer than 2^32 - 1 edges, found {}; lower the "
                    "threshold or subsample",
                    candidates.size()));
  }
  context.poll();
  // Ties in the order (larger end, smaller end): the order in which dense input arrives.
  const auto in_order = [](const Candidate& a, const Candidate& b) {
    return a.edge.u != b.edge.u ? a.edge.u < b.edge.u : a.edge.v < b.edge.v;
  };
  if (!std::is_sorted(candidates.begin(), candidates.end(), in_order))
    std::sort(candidates.begin(), candidates.end(), in_order);
  radix_sort_by_value(candidates, [](const Candidate& c) { return c.value; });
  context.poll();

  RipsGraph graph(&context.memory);
  graph.size_ = size;
  graph.threshold_ = threshold;
  graph.edges_.reserve(candidates.size());
  graph.values_.reserve(candidates.size());
  for (const Candidate& c : candidates) {
    graph.edges_.push_back(c.edge);
    graph.values_.push_back(c.value);
  }
  candidates = {};
  // A matrix takes 4 n^2 bytes, lists take 16 bytes an edge.
  const double pairs = static_cast<double>(size) * static_cast<double>(size - 1) / 2;
  if (size > 0 && static_cast<double>(graph.edge_count()) >= pairs / 4) {
    graph.lay_out_dense();
  } else {
    graph.lay_out_sparse();
  }
  graph.clique_bound_ = graph.degeneracy_bound();
  return graph;
}

void RipsGraph::lay_out_dense() {
  const auto n = static_cast<std::size_t>(size_);
  matrix_.assign(n * n, kNever);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto [u, v] = edges_[i];
    matrix_[u * n + v] = matrix_[v * n + u] = static_cast<Key>(i + 1);
  }
}

void RipsGraph::lay_out_sparse() {
  offsets_.assign(static_cast<std::size_t>(size_) + 1, 0);
  for (const auto [u, v] : edges_) {
    ++offsets_[u + 1];
    ++offsets_[v + 1];
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  neighbours_.resize(2 * edges_.size());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto [u, v] = edges_[i];
    neighbours_[next[u]++] = {v, static_cast<Key>(i + 1)};
    neighbours_[next[v]++] = {u, static_cast<Key>(i + 1)};
  }
  for (std::size_t v = 0; v + 1 < offsets_.size(); ++v) {
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(offsets_[v]),
              neighbours_.begin() + static_cast<std::ptrdiff_t>(offsets_[v + 1]),
              [](const Neighbour& a, const Neighbour& b) { return a.vertex < b.vertex; });
  }
}

// Matula & Beck (1983): take away a vertex of least degree again and again; the largest degree at
// removal is the degeneracy. Vertices wait in a list sorted by degree, with the start of each bin.
Index RipsGraph::degeneracy_bound() const {
  const auto n = static_cast<std::size_t>(size_);
  if (n == 0) return 0;
  std::vector<std::uint32_t> degree(n, 0);
  for (const auto [u, v] : edges_) {
    ++degree[u];
    ++degree[v];
  }
  std::vector<std::uint32_t> bin(n + 1, 0), order(n), place(n);
  for (const std::uint32_t d : degree) ++bin[d + 1];
  std::partial_sum(bin.begin(), bin.end(), bin.begin());
  std::vector<std::uint32_t> next(bin.begin(), bin.end() - 1);
  for (std::uint32_t v = 0; v < n; ++v) {
    place[v] = next[degree[v]]++;
    order[place[v]] = v;
  }
  std::uint32_t degeneracy = 0;
  const auto lower_degree = [&](std::uint32_t w, std::uint32_t floor) {
    if (degree[w] <= floor) return;  // already taken away, or cannot fall below the current least
    const std::uint32_t first = bin[degree[w]], other = order[first];
    std::swap(order[place[w]], order[first]);
    std::swap(place[w], place[other]);
    ++bin[degree[w]--];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t v = order[i], least = degree[v];
    degeneracy = std::max(degeneracy, least);
    if (is_dense()) {
      for (std::uint32_t w = 0; w < n; ++w)
        if (row(v)[w] != kNever) lower_degree(w, least);
    } else {
      for (const Neighbour& w : neighbours(v)) lower_degree(w.vertex, least);
    }
  }
  return Index{degeneracy} + 1;
}

}  // namespace ph
