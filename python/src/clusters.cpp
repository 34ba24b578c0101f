// SPDX-License-Identifier: MIT
#include "ph/cluster_tree.hpp"

#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/merge_tree.hpp"
#include "ph/rips.hpp"
#include "ph/sparse_distances.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/recipes.hpp"

namespace ph::python {
namespace {

using Cluster = ClusterTree::Cluster;

/// @param size the number of points of the input, some of which may have been left out. They never
/// enter.
/// @return the birth of each point of the input, and the values and ends of the edges in ascending
/// order.
py::tuple spanning_forest_of(const RipsRecipe& recipe, const RunOptions& options,
                             std::size_t size) {
  Options components;
  components.max_dim = 0;
  std::vector<double> births(size, kInfinity), values;
  std::vector<Index> u, v;
  run(options, recipe.is_short(components), [&](const RunContext& context) {
    const Built built = recipe.build(context);
    const RipsGraph& forest = std::get<Rips>(built.complex).graph(RipsForm::forest, context);
    const std::vector<Index>& ids = recipe.vertex_ids();
    const auto id = [&](std::uint32_t vertex) {
      const Index point = forest.name(vertex);
      return ids.empty() ? point : ids[static_cast<std::size_t>(point)];
    };
    for (std::uint32_t w = 0; w < forest.size(); ++w)
      births[static_cast<std::size_t>(id(w))] = forest.birth(w);
    for (const FlagEdge& e : forest.edges()) {
      values.push_back(e.value);
      u.push_back(id(e.u));
      v.push_back(id(e.v));
    }
    return 0;
  });
  return py::make_tuple(Block::of(std::move(births)), Block::of(std::move(values)),
                        Block::of(std::move(u)), Block::of(std::move(v)));
}

std::vector<WeightedEdge> edges_of(const py::buffer& u, const py::buffer& v,
                                   const py::buffer& values) {
  const std::vector<Index> from = vector_of<Index>(u), to = vector_of<Index>(v);
  const std::vector<double> value = vector_of<double>(values);
  std::vector<WeightedEdge> edges;
  edges.reserve(value.size());
  for (std::size_t i = 0; i < value.size(); ++i) edges.push_back({from[i], to[i], value[i]});
  return edges;
}

ClusterTree tree_of(Index points, const py::buffer& u, const py::buffer& v,
                    const py::buffer& values, Index min_size, ClusterScale scale,
                    const RunOptions& options) {
  const std::vector<WeightedEdge> edges = edges_of(u, v, values);
  return run(options, false, [&](const RunContext& context) {
    return ClusterTree(points, edges, min_size, scale, context);
  });
}

/// @param births one per vertex; a vertex with an infinite birth never enters.
MergeTree merge_tree_of(const py::buffer& births, const py::buffer& u, const py::buffer& v,
                        const py::buffer& values, const RunOptions& options) {
  const std::vector<double> births_of_vertices = vector_of<double>(births);
  const std::vector<WeightedEdge> edges = edges_of(u, v, values);
  return run(options, false, [&](const RunContext& context) {
    return merge_tree(FilteredGraph(births_of_vertices, edges, context), context);
  });
}

Block core_distances_of_added(const py::buffer& points, const py::buffer& added, Index neighbours,
                              PointDistance distance, double p, const RunOptions& options) {
  const py::buffer_info of_points = points.request(), of_added = added.request();
  const PointsView view = points_of(of_points), added_view = points_of(of_added);
  return Block::of(run(options, false, [&](const RunContext& context) {
    return core_distances_among(view, added_view, neighbours, distance, p, context);
  }));
}

/// @return for each added point, a point of the hierarchy, or -1, and the value of the edge.
py::tuple attachments_of(const py::buffer& points, const py::buffer& births,
                         const py::buffer& added, const py::buffer& added_births,
                         PointDistance distance, double p, const RunOptions& options) {
  const py::buffer_info of_points = points.request(), of_added = added.request();
  const PointsView view = points_of(of_points), added_view = points_of(of_added);
  const std::vector<double> born = vector_of<double>(births),
                            added_born = vector_of<double>(added_births);
  const std::vector<Attachment> found = run(options, false, [&](const RunContext& context) {
    return attachments(view, born, added_view, added_born, distance, p, context);
  });
  std::vector<Index> point;
  std::vector<double> value;
  for (const Attachment& a : found) {
    point.push_back(a.point);
    value.push_back(a.value);
  }
  return py::make_tuple(Block::of(std::move(point)), Block::of(std::move(value)));
}

py::tuple blocks_of(Clusters found) {
  return py::make_tuple(Block::of(std::move(found.labels)),
                        Block::of(std::move(found.probabilities)),
                        Block::of(std::vector<Index>(found.chosen.begin(), found.chosen.end())));
}

/// @param points, values the Attachment of each added point.
py::tuple located_of(const ClusterTree& tree, const py::buffer& points, const py::buffer& values,
                     const ClusterOptions& options) {
  const std::vector<Index> point = vector_of<Index>(points);
  const std::vector<double> value = vector_of<double>(values);
  std::vector<Attachment> added;
  added.reserve(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) added.push_back({point[i], value[i]});
  return blocks_of(tree.locate(added, options));
}

/// One member of the clusters, as an array with one entry per cluster.
template <class Number, class Member>
Block column(const ClusterTree& tree, Member Cluster::*member) {
  std::vector<Number> numbers;
  numbers.reserve(tree.clusters().size());
  for (const Cluster& c : tree.clusters()) numbers.push_back(c.*member);
  return Block::of(std::move(numbers));
}

}  // namespace

void bind_clusters(py::module_& m) {
  py::class_<ClusterTree>(m, "ClusterTree")
      .def(py::init(&tree_of), py::arg("points"), py::arg("u"), py::arg("v"), py::arg("values"),
           py::arg("min_size"), py::arg("scale"), py::arg("run"))
      .def_property_readonly(
          "parents", [](const ClusterTree& t) { return column<Index>(t, &Cluster::parent); })
      .def_property_readonly("tops",
                             [](const ClusterTree& t) { return column<double>(t, &Cluster::top); })
      .def_property_readonly(
          "bottoms", [](const ClusterTree& t) { return column<double>(t, &Cluster::bottom); })
      .def_property_readonly(
          "least", [](const ClusterTree& t) { return column<double>(t, &Cluster::least); })
      .def_property_readonly("sizes",
                             [](const ClusterTree& t) { return column<Index>(t, &Cluster::size); })
      .def_property_readonly("masses",
                             [](const ClusterTree& t) { return column<double>(t, &Cluster::mass); })
      .def_property_readonly(
          "cluster_of",
          [](const ClusterTree& t) {
            return Block::of(std::vector<Index>(t.cluster_of().begin(), t.cluster_of().end()));
          })
      .def_property_readonly("leaves_at",
                             [](const ClusterTree& t) { return Block::copy_of(t.leaves_at()); })
      .def(
          "select",
          [](const ClusterTree& t, ClusterMethod method, double epsilon, bool allow_single,
             Index max_size) {
            return blocks_of(t.select({method, epsilon, allow_single, max_size}));
          },
          py::arg("method"), py::arg("epsilon"), py::arg("allow_single"), py::arg("max_size"))
      .def(
          "locate",
          [](const ClusterTree& t, const py::buffer& points, const py::buffer& values,
             ClusterMethod method, double epsilon, bool allow_single, Index max_size) {
            return located_of(t, points, values, {method, epsilon, allow_single, max_size});
          },
          py::arg("points"), py::arg("values"), py::arg("method"), py::arg("epsilon"),
          py::arg("allow_single"), py::arg("max_size"))
      .def("outlier_scores", [](const ClusterTree& t) { return Block::of(t.outlier_scores()); })
      .def(
          "with_min_size",
          [](const ClusterTree& t, Index min_size, const RunOptions& options) {
            return run(options, false, [&](const RunContext& context) {
              return t.with_min_size(min_size, context);
            });
          },
          py::arg("min_size"), py::arg("run"));
  m.def("core_distances_among", &core_distances_of_added, py::arg("points"), py::arg("added"),
        py::arg("neighbours"), py::arg("distance"), py::arg("p"), py::arg("run"));
  m.def("attachments", &attachments_of, py::arg("points"), py::arg("births"), py::arg("added"),
        py::arg("added_births"), py::arg("distance"), py::arg("p"), py::arg("run"));
  m.def("merge_tree_of_forest", &merge_tree_of, py::arg("births"), py::arg("u"), py::arg("v"),
        py::arg("values"), py::arg("run"));
  m.def("spanning_forest", &spanning_forest_of, py::arg("recipe"), py::arg("run"), py::arg("size"));
}

}  // namespace ph::python
