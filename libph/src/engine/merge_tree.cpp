// SPDX-License-Identifier: MIT
#include "ph/engine/merge_tree.hpp"

#include "ph/complex/cubical.hpp"
#include "ph/complex/explicit.hpp"
#include "ph/complex/rips.hpp"
#include "ph/core/barcode.hpp"
#include "ph/core/error.hpp"
#include "ph/engine/filtered_graph.hpp"

namespace ph {
namespace {

template <GraphFiltration F>
MergeTree tree_of(const F& f, const RunContext& context) {
  const FilteredGraph<F> graph(f, context);
  MergeTree tree;
  tree.births.reserve(graph.vertices.size());
  for (const auto& v : graph.vertices) tree.births.push_back(f.value(v));
  std::vector<Index> sizes(graph.vertices.size(), 1);
  join_by_elder_rule(graph.age, graph.ends, context,
                     [&](std::size_t edge, std::uint32_t elder, std::uint32_t younger) {
                       tree.merges.push_back({f.value(graph.edges[edge]), graph.ends[edge].u,
                                              graph.ends[edge].v, elder, younger, sizes[elder],
                                              sizes[younger], tree.births[elder],
                                              tree.births[younger]});
                       sizes[elder] += sizes[younger];
                     });
  return tree;
}

}  // namespace

std::vector<Index> MergeTree::components(double value) const {
  std::vector<Index> parent(births.size());
  for (std::size_t v = 0; v < births.size(); ++v)
    parent[v] = births[v] <= value ? static_cast<Index>(v) : -1;
  for (const Merge& m : merges) {
    if (m.value > value) break;
    parent[static_cast<std::size_t>(m.younger)] = m.elder;
  }
  // A parent was born before its child: follow to the root, halving the path for those to come.
  for (std::size_t v = 0; v < parent.size(); ++v) {
    for (Index root = parent[v]; root >= 0;) {
      Index& up = parent[static_cast<std::size_t>(root)];
      if (up == root) {
        parent[v] = root;
        break;
      }
      up = parent[static_cast<std::size_t>(up)];
      root = up;
    }
  }
  return parent;
}

MergeTree merge_tree(const Rips& rips, const RunContext& context) {
  return rips.with_filtration(0, [&](const auto& f) { return tree_of(f, context); });
}

MergeTree merge_tree(const Cubical& cubical, const RunContext& context) {
  return tree_of(cubical, context);
}

MergeTree merge_tree(const ExplicitComplex& complex, const RunContext& context) {
  if (!complex.edges_join_vertices()) {
    throw Error(ErrorKind::usage, "a merge tree needs edges that join two vertices");
  }
  return tree_of(complex, context);
}

}  // namespace ph
