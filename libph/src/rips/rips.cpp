// SPDX-License-Identifier: MIT
#include "ph/rips.hpp"

#include <fmt/format.h>

#include "metric/distinct_points.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/detail/rips/rips_vertices.hpp"
#include "ph/detail/rips/sparse_rips.hpp"
#include "ph/error.hpp"
#include "rips/beta_skeleton/points_alone.hpp"

namespace ph {
namespace {

Points rows_of(PointsView points, std::span<const std::uint32_t> rows) {
  Points chosen(static_cast<Index>(rows.size()), points.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::copy_n(points.row(rows[i]), points.cols(), chosen.row(static_cast<Index>(i)).data());
  return chosen;
}

/// @param weights of the points, which all become vertices.
RipsGraph graph_of_all_points(PointsView points, const RipsOptions& options,
                              const VertexWeights& weights, const RunContext& context) {
  const bool is_weighted = !weights.births().empty();
  if (options.device == Device::gpu)
    return RipsGraph::forest_on_gpu(points, options.threshold, context);
  if (options.approximation) {
    const GreedyPermutation order =
        greedy_permutation(points, {}, options.distance, options.minkowski_p, context);
    return sparse_rips_graph(PointMetric(points, options.distance, options.minkowski_p), order,
                             *options.approximation, options.threshold, context);
  }
  if (options.only_points) return RipsGraph::of_points_alone(points, options.threshold, context);
  if (options.only_components && !is_weighted &&
      has_fast_spanning_forest(points, options.distance)) {
    return RipsGraph::forest_of_points(points, options.distance, options.minkowski_p,
                                       options.threshold, context);
  }
  if (!options.only_components && options.distance == PointDistance::euclidean &&
      options.threshold && points.cols() <= 32) {
    return RipsGraph::of_points_within(points, *options.threshold, context, weights);
  }
  const PointMetric metric(points, options.distance, options.minkowski_p);
  return options.only_components
             ? RipsGraph::forest_of_metric(metric, options.threshold, context, weights)
             : RipsGraph::of_metric(metric, options.threshold, context, weights);
}

RipsGraph graph_of_distinct_points(PointsView points, const RipsOptions& options,
                                   const VertexWeights& weights, const RunContext& context) {
  // Copies with births would be one vertex with the first of them: not worth the code.
  if (options.merge_equal_points && weights.births().empty()) {
    const PointMetric checked(points, options.distance, options.minkowski_p);
    const std::pmr::vector<std::uint32_t> firsts =
        distinct_points(first_equal_points(checked.points(), context), context);
    if (static_cast<Index>(firsts.size()) < points.rows()) {
      const Points distinct = rows_of(checked.points(), firsts);
      RipsGraph graph = graph_of_all_points(distinct, options, weights, context);
      graph.name_vertices(firsts, context);
      return graph;
    }
  }
  return graph_of_all_points(points, options, weights, context);
}

/// What is asked for that a GPU does not do; empty: nothing.
std::string_view beyond_gpu(const RipsOptions& options) {
  if (options.distance != PointDistance::euclidean) return "another distance";
  if (!options.births.empty()) return "births of vertices";
  if (!options.only_components || options.only_points)
    return "more than components; max_dim 0 asks for them alone, without an approximation, a check "
           "or an engine by name";
  return "";
}

/// @param data what the filtration is of, if not of points.
void check_device(const RipsOptions& options, std::string_view data = "") {
  if (options.device == Device::cpu) return;
  const std::string_view found = data.empty() ? beyond_gpu(options) : data;
  if (!found.empty())
    throw Error(ErrorKind::usage,
                fmt::format("device gpu: computes components (H0) of points with Euclidean "
                            "distances, found {}",
                            found));
}

void check_together(const RipsOptions& options) {
  if (options.only_points)
    throw Error(ErrorKind::usage,
                "a Rips filtration of points alone needs points, found distances");
  if (!options.approximation) return;
  if (options.only_components || !options.births.empty()) {
    throw Error(ErrorKind::usage,
                fmt::format("sparse Rips filtrations have no {}",
                            options.only_components ? "spanning forest" : "births of vertices"));
  }
}

void check_points_alone(PointsView points, const RipsOptions& options) {
  const std::string_view obstacle = obstacle_to_points_alone(points, options);
  if (!obstacle.empty())
    throw Error(ErrorKind::usage,
                fmt::format("a Rips filtration of points alone needs {}", obstacle));
}

RipsGraph graph_of_points(PointsView points, const RipsOptions& options,
                          const RunContext& context) {
  RipsGraph::check_arguments(points.rows(), options.threshold);
  check_device(options);
  if (options.only_points)
    check_points_alone(points, options);
  else
    check_together(options);
  const RipsVertices vertices(points.rows(), options.vertices, options.births,
                              options.weight_exponent, options.threshold, context);
  if (vertices.are_all())
    return graph_of_distinct_points(points, options, vertices.weights(), context);
  const PointMetric checked(points, options.distance, options.minkowski_p);
  const Points chosen = rows_of(checked.points(), vertices.members());
  RipsGraph graph = graph_of_distinct_points(chosen, options, vertices.weights(), context);
  graph.name_vertices(vertices.members(), context);
  return graph;
}

RipsGraph graph_of_sparse(const SparseDistances& distances, const RipsOptions& options,
                          const RunContext& context) {
  check_device(options, "some distances");
  if (options.only_points) check_together(options);
  if (options.approximation)
    throw Error(ErrorKind::usage, "sparse Rips filtrations need all distances, found some of them");
  const auto build = options.only_components ? RipsGraph::forest_of_edges : RipsGraph::of_edges;
  const RipsVertices vertices(distances.size(), options.vertices, options.births,
                              options.weight_exponent, options.threshold, context);
  if (vertices.are_all())
    return build(distances.size(), distances.edges(), options.threshold, context,
                 vertices.weights());
  const std::pmr::vector<std::uint32_t>& members = vertices.members();
  std::pmr::vector<Index> number(static_cast<std::size_t>(distances.size()), -1, &context.memory);
  for (std::size_t v = 0; v < members.size(); ++v) number[members[v]] = static_cast<Index>(v);
  std::pmr::vector<WeightedEdge> edges(&context.memory);
  for (const WeightedEdge& e : distances.edges()) {
    const Index u = number[static_cast<std::size_t>(e.u)],
                v = number[static_cast<std::size_t>(e.v)];
    if (u >= 0 && v >= 0) edges.push_back({u, v, e.value});
  }
  RipsGraph graph = build(static_cast<Index>(members.size()), edges, options.threshold, context,
                          vertices.weights());
  graph.name_vertices(members, context);
  return graph;
}

template <Metric M>
RipsGraph graph_of_metric(const M& metric, const RipsOptions& options, const RunContext& context) {
  RipsGraph::check_arguments(metric.size(), options.threshold);
  check_device(options, "distances");
  check_together(options);
  const RipsVertices vertices(metric.size(), options.vertices, options.births,
                              options.weight_exponent, options.threshold, context);
  const auto build = [&](const auto& distances) {
    if (options.approximation)
      return sparse_rips_graph(distances, greedy_permutation(distances, {}, context),
                               *options.approximation, options.threshold, context);
    return options.only_components
               ? RipsGraph::forest_of_metric(distances, options.threshold, context,
                                             vertices.weights())
               : RipsGraph::of_metric(distances, options.threshold, context, vertices.weights());
  };
  if (vertices.are_all()) return build(metric);
  RipsGraph graph = build(SubsetMetric(metric, vertices.members()));
  graph.name_vertices(vertices.members(), context);
  return graph;
}

RipsOptions with_births_of(const DistanceMatrix& distances, RipsOptions options) {
  if (options.births.empty()) options.births = distances.births();
  return options;
}

}  // namespace

Rips::Rips(PointsView points, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(graph_of_points(points, options, context))) {}

Rips::Rips(const DistanceMatrix& distances, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(
          graph_of_metric(distances, with_births_of(distances, options), context))) {}

Rips::Rips(const SparseDistances& distances, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(graph_of_sparse(distances, options, context))) {}

Rips::Rips(const AnyMetric& metric, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(graph_of_metric(metric, options, context))) {}

Rips::Rips(RipsGraph&& graph) : graph_(std::make_shared<const RipsGraph>(std::move(graph))) {}

Index Rips::size() const { return graph_->size(); }
double Rips::threshold() const { return graph_->threshold(); }
std::size_t Rips::edge_count() const { return graph_->edge_count(); }
bool Rips::has_only_components() const { return graph_->is_forest(); }
bool Rips::has_only_points() const { return graph_->points_alone() != nullptr; }

}  // namespace ph
