// SPDX-License-Identifier: MIT
#include "libph/src/rips/make_graph.hpp"

#include <fmt/format.h>

#include "libph/src/metric/distinct_points.hpp"
#include "ph/detail/rips/rips_vertices.hpp"
#include "ph/detail/rips/sparse_rips.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// Copies some rows. The memory of the copy is counted until the copy is freed.
HeldPoints rows_of(PointsView points, std::span<const std::uint32_t> rows,
                   const RunContext& context) {
  struct Copy {
    MemoryClaim claim;
    Points points;
  };
  const std::size_t bytes = rows.size() * static_cast<std::size_t>(points.cols()) * sizeof(double);
  const std::shared_ptr<Copy> copy(
      new Copy{{context.memory, bytes}, {static_cast<Index>(rows.size()), points.cols()}});
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::copy_n(points.row(rows[i]), points.cols(), copy->points.row(static_cast<Index>(i)).data());
  return {copy->points, {copy, &copy->points}};
}

WeightExponent exponent_of(const RipsOptions& options) {
  return options.weight_exponent.value_or(options.dtm_neighbours ? WeightExponent::one
                                                                 : WeightExponent::infinity);
}

bool merges_equal_points(const RipsOptions& options, RipsForm form) {
  switch (form) {
    case RipsForm::edges:
      return false;
    case RipsForm::distinct_edges:
      return true;
    case RipsForm::points:
      return options.merge_equal_points.value_or(true);
    case RipsForm::forest:
      break;
  }
  return options.merge_equal_points.value_or(false);
}

RipsGraph forest_of_points(PointsView points, const RipsOptions& options,
                           const VertexWeights& weights, const RunContext& context) {
  if (options.device == Device::gpu)  // mutant: device-gpu
    return RipsGraph::forest_on_gpu(points, options.threshold, context);
  // Points without coordinates are copies, which a tree can hold only if they are merged.
  const bool has_fast_births = weights.exponent() == WeightExponent::infinity && points.cols() > 0;
  if ((weights.births().empty() || has_fast_births) &&
      has_fast_spanning_forest(points, options.distance))
    return RipsGraph::forest_of_points(points, options.distance, options.minkowski_p,
                                       weights.births(), options.threshold, context);
  PointMetric metric(points, options.distance, options.minkowski_p);
  metric.keep_directions(context);
  return RipsGraph::forest_of_metric(metric, options.threshold, context, weights);
}

RipsGraph edges_of_points(PointsView points, const RipsOptions& options,
                          const VertexWeights& weights, const RunContext& context) {
  PointMetric metric(points, options.distance, options.minkowski_p);
  metric.keep_directions(context);
  if (options.approximation) {
    const GreedyPermutation order =
        greedy_permutation(points, {}, options.distance, options.minkowski_p, context);
    return sparse_rips_graph(metric, order, *options.approximation, options.threshold, context);
  }
  constexpr Index most_coordinates_of_tree = 32;
  if (options.distance == PointDistance::euclidean && options.threshold &&
      points.cols() <= most_coordinates_of_tree)
    return RipsGraph::of_points_within(points, *options.threshold, context, weights);
  return RipsGraph::of_metric(metric, options.threshold, context, weights);
}

/// @param weights the weights of the points, all of which become vertices.
RipsGraph graph_of_all_points(const HeldPoints& points, const RipsOptions& options, RipsForm form,
                              const VertexWeights& weights, const RunContext& context) {
  if (form == RipsForm::points)
    return RipsGraph::of_points_alone(points.view, points.owner, options.threshold, context);
  if (form == RipsForm::forest) return forest_of_points(points.view, options, weights, context);
  return edges_of_points(points.view, options, weights, context);
}

RipsGraph graph_of_distinct_points(const HeldPoints& points, const RipsOptions& options,
                                   RipsForm form, const VertexWeights& weights,
                                   const RunContext& context) {
  // Equal points with births are not merged, because merging them is not worth the extra code.
  if (merges_equal_points(options, form) && weights.births().empty()) {
    const WholeRows whole(points.view);
    const std::pmr::vector<std::uint32_t> firsts =
        distinct_points(first_equal_points(whole.view(), context), context);
    if (static_cast<Index>(firsts.size()) < points.view.rows()) {
      RipsGraph graph = graph_of_all_points(rows_of(whole.view(), firsts, context), options, form,
                                            weights, context);
      graph.name_vertices(firsts, context);
      return graph;
    }
  }
  return graph_of_all_points(points, options, form, weights, context);
}

template <Metric M>
RipsGraph graph_of_metric(const M& metric, const RipsOptions& options, RipsForm form,
                          const RipsVertices& vertices, const RunContext& context) {
  const auto build = [&](const auto& distances) {
    if (options.approximation)
      return sparse_rips_graph(distances, greedy_permutation(distances, {}, context),
                               *options.approximation, options.threshold, context);
    return form == RipsForm::forest
               ? RipsGraph::forest_of_metric(distances, options.threshold, context,
                                             vertices.weights())
               : RipsGraph::of_metric(distances, options.threshold, context, vertices.weights());
  };
  if (vertices.are_all()) return build(metric);
  RipsGraph graph = build(SubsetMetric(metric, vertices.members()));
  graph.name_vertices(vertices.members(), context);
  return graph;
}

/// Makes a form of the filtration, for each kind of data.
struct Maker {
  const RipsOptions& options;
  RipsForm form;
  const RipsVertices& vertices;
  const RunContext& context;

  RipsGraph operator()(const HeldPoints& points) const {
    if (vertices.are_all())
      return graph_of_distinct_points(points, options, form, vertices.weights(), context);
    const WholeRows whole(points.view);
    RipsGraph graph = graph_of_distinct_points(rows_of(whole.view(), vertices.members(), context),
                                               options, form, vertices.weights(), context);
    graph.name_vertices(vertices.members(), context);
    return graph;
  }
  RipsGraph operator()(const DistanceMatrix& distances) const {
    return graph_of_metric(distances, options, form, vertices, context);
  }
  RipsGraph operator()(const HeldMetric& held) const {
    return graph_of_metric(held.metric, options, form, vertices, context);
  }
  RipsGraph operator()(const SparseDistances& distances) const {
    const auto build = form == RipsForm::forest ? RipsGraph::forest_of_edges : RipsGraph::of_edges;
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
};

/// @throws Error (usage) if the task cannot be computed on a GPU.
void check_device(const RipsData& data, const RipsOptions& options) {
  if (options.device == Device::cpu) return;
  std::string_view found;
  if (std::holds_alternative<SparseDistances>(data))
    found = "a sparse matrix of distances";
  else if (!std::holds_alternative<HeldPoints>(data))
    found = "distances";
  else if (options.distance != PointDistance::euclidean)  // mutant: device-distance
    found = "a distance that is not Euclidean";
  else if (!options.births.empty() || options.computes_births())  // mutant: device-births
    found = "births of vertices";
  if (!found.empty())
    throw Error(
        ErrorKind::usage,
        fmt::format("device gpu: found {}, expected components (H0) of points with Euclidean "
                    "distances",
                    found));
}

void check_approximation(const RipsData& data, const RipsOptions& options) {
  if (!options.approximation) return;
  if (std::holds_alternative<SparseDistances>(data))
    throw Error(ErrorKind::usage, "sparse Rips filtrations need all distances, found only some");
  const auto* matrix = std::get_if<DistanceMatrix>(&data);
  if (!options.births.empty() || options.computes_births() || (matrix && !matrix->births().empty()))
    throw Error(ErrorKind::usage,
                "sparse Rips filtrations need vertices that enter at 0, found births of vertices");
  SparseRips::check_epsilon(*options.approximation);
}

}  // namespace

Index size_of(const RipsData& data) {
  struct Size {
    Index operator()(const HeldPoints& points) const { return points.view.rows(); }
    Index operator()(const HeldMetric& held) const { return held.metric.size(); }
    Index operator()(const DistanceMatrix& distances) const { return distances.size(); }
    Index operator()(const SparseDistances& distances) const { return distances.size(); }
  };
  return std::visit(Size{}, data);
}

void check_options(const RipsData& data, const RipsOptions& options, const RunContext& context) {
  const Index size = size_of(data);
  RipsGraph::check_arguments(size, options.threshold);
  check_device(data, options);
  check_approximation(data, options);
  if (std::holds_alternative<SparseDistances>(data) &&
      (options.subsample || options.computes_births()))
    throw Error(ErrorKind::usage,
                "distances: found only some, expected all for a subsample, a distance to a measure "
                "or core distances");
  if (options.subsample) detail::check(*options.subsample, size);
  if (options.dtm_neighbours && options.core_neighbours)
    throw Error(ErrorKind::usage,
                "births: found neighbours for both the distance to a measure and core distances, "
                "expected one of them");
  if (options.dtm_neighbours && size > 0) detail::check_neighbours(*options.dtm_neighbours, size);
  if (options.core_neighbours && size > 0)
    detail::check_core_neighbours(*options.core_neighbours, size);
  const auto* matrix = std::get_if<DistanceMatrix>(&data);
  const std::span<const double> births =
      matrix && options.births.empty() ? matrix->births() : std::span(options.births);
  RipsVertices(size, options.vertices, births, exponent_of(options), options.threshold, context);
  if (const auto* points = std::get_if<HeldPoints>(&data))
    PointMetric(points->view, options.distance, options.minkowski_p);
}

std::optional<RipsGraph> make_core_forest(const RipsData& data, const RipsOptions& options,
                                          const RunContext& context) {
  constexpr Index most_neighbours = 16;  // all points keep their neighbours until the last search
  const auto* points = std::get_if<HeldPoints>(&data);
  const Index k = options.core_neighbours.value_or(0);
  if (!points || k < 1 || k > most_neighbours || points->view.rows() == 0 ||
      points->view.cols() == 0 || options.threshold.value_or(kInfinity) < kInfinity ||
      !options.vertices.empty() || options.subsample || options.device == Device::gpu ||
      exponent_of(options) != WeightExponent::infinity ||
      !has_fast_spanning_forest(points->view, options.distance))
    return std::nullopt;
  return RipsGraph::core_forest_of_points(points->view, k, options.distance, options.minkowski_p,
                                          context);
}

RipsGraph make_graph(const RipsData& data, const RipsOptions& options, RipsForm form,
                     const ChosenVertices& chosen, const RunContext& context) {
  const RipsVertices vertices(size_of(data), chosen.vertices, chosen.births, exponent_of(options),
                              options.threshold, context);
  return std::visit(Maker{options, form, vertices, context}, data);
}

}  // namespace ph
