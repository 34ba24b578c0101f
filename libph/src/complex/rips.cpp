// SPDX-License-Identifier: MIT
#include "ph/complex/rips.hpp"

#include "../metric/distinct_points.hpp"

namespace ph {
namespace {

RipsGraph graph_of_all_points(const Points& points, const RipsOptions& options,
                              const RunContext& context) {
  if (options.distance == PointDistance::euclidean && options.threshold && points.cols() <= 32) {
    return RipsGraph::of_points_within(points, *options.threshold, context);
  }
  return RipsGraph::of_metric(PointMetric(points, options.distance, options.minkowski_p),
                              options.threshold, context);
}

RipsGraph graph_of_points(const Points& points, const RipsOptions& options,
                          const RunContext& context) {
  RipsGraph::check_size(points.rows());
  if (options.merge_equal_points) {
    const PointMetric checked(points, options.distance, options.minkowski_p);
    std::pmr::vector<std::uint32_t> firsts = first_of_equal_points(checked.points(), context);
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
    : graph_(std::make_shared<const RipsGraph>(
          RipsGraph::of_metric(distances, options.threshold, context))) {}

Rips::Rips(const SparseDistances& distances, const RipsOptions& options, const RunContext& context)
    : graph_(std::make_shared<const RipsGraph>(
          RipsGraph::of_edges(distances.size(), distances.edges(), options.threshold, context))) {}

}  // namespace ph
