// SPDX-License-Identifier: MIT
#include "ph/complex/rips.hpp"

#include "../metric/distinct_points.hpp"

namespace ph {
namespace {

template <Metric M>
RipsGraph graph_of_metric(const M& metric, const RipsOptions& options, const RunContext& context) {
  return options.only_components ? RipsGraph::forest_of_metric(metric, options.threshold, context)
                                 : RipsGraph::of_metric(metric, options.threshold, context);
}

RipsGraph graph_of_all_points(const Points& points, const RipsOptions& options,
                              const RunContext& context) {
  if (options.only_components && has_fast_spanning_forest(points, options.distance)) {
    return RipsGraph::forest_of_points(points, options.distance, options.minkowski_p,
                                       options.threshold, context);
  }
  if (!options.only_components && options.distance == PointDistance::euclidean &&
      options.threshold && points.cols() <= 32) {
    return RipsGraph::of_points_within(points, *options.threshold, context);
  }
  return graph_of_metric(PointMetric(points, options.distance, options.minkowski_p), options,
                         context);
}

RipsGraph graph_of_points(const Points& points, const RipsOptions& options,
                          const RunContext& context) {
  RipsGraph::check_size(points.rows());
  if (options.merge_equal_points) {
    const PointMetric checked(points, options.distance, options.minkowski_p);
    std::pmr::vector<std::uint32_t> firsts =
        distinct_points(first_equal_points(checked.points(), context), context);
    if (static_cast<Index>(firsts.size()) < points.rows()) {
      const Points distinct = points(firsts, Eigen::all);
      RipsGraph graph = graph_of_all_points(distinct, options, context);
      graph.name_vertices(std::move(firsts));
      return graph;
    }
  }
  return graph_of_all_points(points, options, context);
}

}  // namespace

Rips::Rips(const Points& points, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(graph_of_points(points, options, context))) {}

Rips::Rips(const DistanceMatrix& distances, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(graph_of_metric(distances, options, context))) {}

Rips::Rips(const SparseDistances& distances, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(
          (options.only_components ? RipsGraph::forest_of_edges : RipsGraph::of_edges)(
              distances.size(), distances.edges(), options.threshold, context))) {}

}  // namespace ph
