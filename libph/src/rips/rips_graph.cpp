// SPDX-License-Identifier: MIT
#include "ph/detail/rips/rips_graph.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libph/src/gpu/gpu_forest.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/detail/metric/pairs_within.hpp"
#include "ph/error.hpp"

namespace ph {

void RipsGraph::check_size(Index size) {
  if (size < 0 || size >= Index{UINT32_MAX}) {
    throw Error(ErrorKind::resource,
                fmt::format("Rips filtration: found {} points, expected 0 to 2^32 - 2", size));
  }
}

void RipsGraph::check_arguments(Index size, std::optional<double> threshold) {
  check_size(size);
  if (threshold && !(*threshold >= 0)) {
    throw Error(ErrorKind::usage,
                fmt::format("threshold: found {}, expected a number >= 0", *threshold));
  }
}

double RipsGraph::checked_distance(Index i, Index j, double value) {
  if (value >= 0) return value + 0.0;  // the sum turns -0.0 into +0.0
  throw Error(ErrorKind::bad_data,
              fmt::format("distance ({}, {}): found {}, expected a number >= 0", i, j, value));
}

void RipsGraph::name_vertices(std::span<const std::uint32_t> points, const RunContext& context) {
  std::pmr::vector<std::uint32_t> names(static_cast<std::size_t>(size_), &context.memory);
  for (std::uint32_t v = 0; v < names.size(); ++v)
    names[v] = points[static_cast<std::size_t>(name(v))];
  names_ = std::move(names);
  has_names_ = true;
}

RipsGraph RipsGraph::of_points_within(PointsView points, double threshold,
                                      const RunContext& context, const VertexWeights& weights) {
  check_arguments(points.rows(), threshold);
  EdgeCollector edges(context);
  Ticker ticker(context, "edges");
  for_each_pair_within(
      points, threshold,
      [&](Index i, Index j, double d) {
        ticker.tick();
        const double value = weights.edge_value(i, j, d);
        if (value > threshold) return;
        edges.add({value, static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(i)});
      },
      context);
  return RipsGraph(points.rows(), threshold, bin_edges(edges.finish(), context), context,
                   weights.births());
}

RipsGraph RipsGraph::of_points_alone(PointsView points, std::shared_ptr<const Points> owner,
                                     std::optional<double> threshold, const RunContext& context) {
  check_arguments(points.rows(), threshold);
  RipsGraph graph(points.rows(), threshold.value_or(kNoLimit),
                  BinnedEdges(FlagEdges(&context.memory)), context);
  graph.points_ = PointsAlone{points, std::move(owner)};
  return graph;
}

void RipsGraph::throw_no_edges() {
  throw Error(ErrorKind::usage,
              "this Rips filtration holds only the points; this call needs edges");
}

RipsGraph RipsGraph::of_edges(Index size, std::span<const WeightedEdge> edges,
                              std::optional<double> threshold, const RunContext& context,
                              const VertexWeights& weights) {
  check_arguments(size, threshold);
  const double limit = threshold.value_or(kNoLimit);
  // A pair at an infinite distance is not an edge.
  // mutant: rips-sparse-threshold
  const double last = std::min(limit, std::numeric_limits<double>::max());
  const auto value_of = [&](const WeightedEdge& e) {
    return weights.edge_value(e.u, e.v, e.value);
  };
  EdgeBinner binner(edges.size(), 1, context);
  for (const WeightedEdge& e : edges) binner.count(value_of(e));
  binner.allocate(last);
  for (const WeightedEdge& e : edges) {
    const double value = value_of(e);
    if (value > last) continue;
    const auto [small, large] = std::minmax(e.u, e.v);
    binner.add({value, static_cast<std::uint32_t>(large), static_cast<std::uint32_t>(small)});
  }
  return RipsGraph(size, limit, binner.finish(), context, weights.births());
}

RipsGraph RipsGraph::with_edges(const RipsGraph& graph, FlagEdges&& edges,
                                const RunContext& context) {
  RipsGraph result(graph.size_, graph.threshold_, BinnedEdges(std::move(edges)), context,
                   graph.births_);
  result.names_ = graph.names_;
  result.has_names_ = graph.has_names_;
  return result;
}

RipsGraph RipsGraph::forest_of_points(PointsView points, PointDistance distance, double p,
                                      std::span<const double> births,
                                      std::optional<double> threshold, const RunContext& context) {
  check_arguments(points.rows(), threshold);
  const double limit = threshold.value_or(kNoLimit);
  return of_forest(points.rows(), limit,
                   spanning_forest(points, distance, p, births, limit, context), context, births);
}

RipsGraph RipsGraph::core_forest_of_points(PointsView points, Index neighbours,
                                           PointDistance distance, double p,
                                           const RunContext& context) {
  check_arguments(points.rows(), std::nullopt);
  ForestWithBirths found = core_forest(points, neighbours, distance, p, kNoLimit, context);
  return of_forest(points.rows(), kNoLimit, std::move(found.edges), context, found.births);
}

RipsGraph RipsGraph::forest_on_gpu(PointsView points, std::optional<double> threshold,
                                   const RunContext& context) {
  check_arguments(points.rows(), threshold);
  const double limit = threshold.value_or(kNoLimit);
  // The forest is sorted.
  BinnedEdges edges(gpu::spanning_forest(PointMetric(points), limit, context));
  RipsGraph graph(points.rows(), limit, std::move(edges), context);
  graph.is_forest_ = true;
  return graph;
}

RipsGraph RipsGraph::forest_of_edges(Index size, std::span<const WeightedEdge> edges,
                                     std::optional<double> threshold, const RunContext& context,
                                     const VertexWeights& weights) {
  const RipsGraph graph = of_edges(size, edges, threshold, context, weights);
  DisjointSets sets(static_cast<std::size_t>(size), &context.memory);
  FlagEdges forest(&context.memory);
  for (const FlagEdge& e : graph.edges()) {  // this is Kruskal's algorithm
    const std::uint32_t a = sets.find(e.u), b = sets.find(e.v);
    if (a == b) continue;
    sets.link(a, b);
    forest.push_back(e);
  }
  return of_forest(size, graph.threshold_, std::move(forest), context, weights.births());
}

RipsGraph RipsGraph::of_forest(Index size, double limit, FlagEdges&& forest,
                               const RunContext& context, std::span<const double> births) {
  RipsGraph graph(size, limit, bin_edges(std::move(forest), context), context, births);
  graph.is_forest_ = true;
  return graph;
}

Index RipsGraph::range_begin(Index rows, std::size_t r, std::size_t ranges) {
  const double share = static_cast<double>(r) / static_cast<double>(ranges);
  return r == ranges ? rows : static_cast<Index>(std::sqrt(share) * static_cast<double>(rows));
}

std::size_t RipsGraph::range_count(Index rows, const RunContext& context) {
  constexpr Index few = 512;
  constexpr std::size_t ranges_a_thread = 4, most = 64;
  const std::size_t threads = thread_count(context);
  return threads == 1 || rows < few ? 1 : std::min(most, ranges_a_thread * threads);
}

RipsGraph::RipsGraph(Index size, double threshold, BinnedEdges&& edges, const RunContext& context,
                     std::span<const double> births)
    : size_(size),
      threshold_(threshold),
      edges_(std::move(edges)),
      names_(&context.memory),
      births_(births.begin(), births.end(), &context.memory) {
  if (edges_.size() >= RipsAdjacency::kNever) {
    throw Error(ErrorKind::resource, fmt::format("Rips filtration: found {} edges, expected fewer "
                                                 "than 2^32 - 1; lower the threshold or subsample",
                                                 edges_.size()));
  }
}

}  // namespace ph
