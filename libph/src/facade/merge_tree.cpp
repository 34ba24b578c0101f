// SPDX-License-Identifier: MIT
#include "ph/merge_tree.hpp"
#include "ph/detail/rips/rips_filtration.hpp"

#include <algorithm>
#include <concepts>
#include <numeric>
#include <span>
#include <utility>

#include "libph/src/facade/rips_plan.hpp"
#include "ph/alpha.hpp"
#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/detail/complex/cubical_cells.hpp"
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/detail/components/one_skeleton.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/detail/facade/adjust.hpp"
#include "ph/error.hpp"
#include "ph/explicit.hpp"
#include "ph/rips.hpp"

namespace ph {
namespace {

template <GraphFiltration F>
MergeTree tree_of(const F& f, const RunContext& context) {
  const OneSkeleton<F> graph(f, context);
  MergeTree tree;
  tree.births.reserve(graph.vertices.size());
  for (const auto& v : graph.vertices) tree.births.push_back(f.value(v));
  std::vector<Index> sizes(graph.vertices.size(), 1);
  join_by_elder_rule(
      graph.age, graph.ends, context,
      [&](std::size_t edge, std::uint32_t elder, std::uint32_t younger) {
        tree.merges.push_back({f.value(graph.edges[edge]), graph.ends[edge].u, graph.ends[edge].v,
                               elder, younger, sizes[elder], sizes[younger], tree.births[elder],
                               tree.births[younger]});
        sizes[elder] += sizes[younger];  // mutant: merge-sizes
      });
  // Translates vertices to their numbers in the input, where vertices that never enter are numbered
  // as well.
  if constexpr (requires { f.vertex_number(graph.vertices[0]); }) {  // mutant: merge-tree-numbers
    std::vector<Index> number;
    number.reserve(graph.vertices.size());
    for (const auto& v : graph.vertices) number.push_back(static_cast<Index>(f.vertex_number(v)));
    return with_input_ids(std::move(tree), number, f.vertex_count());
  }
  return tree;
}

}  // namespace

std::vector<Index> MergeTree::components(double value) const {
  std::vector<Index> parent(births.size());
  for (std::size_t v = 0; v < births.size(); ++v)
    parent[v] = births[v] <= value && births[v] < kInfinity ? static_cast<Index>(v) : -1;
  for (const Merge& m : merges) {
    // mutant: merges-at-value
    if (!(m.value <= value)) break;  // the loop stops at once if `value` is NaN
    parent[static_cast<std::size_t>(m.younger)] = m.elder;
  }
  // A parent is older than its child, so the loop that follows parents ends at a root. The loop
  // also halves the path, which makes later searches faster.
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

std::vector<Index> MergeTree::basins(double min_persistence, Index min_size) const {
  DisjointSets sets(births.size(), std::pmr::get_default_resource());
  for (const Merge& m : merges) {
    if (m.separates(min_persistence, min_size)) continue;
    sets.link(sets.find(static_cast<std::uint32_t>(m.u)),
              sets.find(static_cast<std::uint32_t>(m.v)));
  }
  std::vector<Index> basins(births.size(), -1);
  for (std::uint32_t v = 0; v < births.size(); ++v)
    if (births[v] < kInfinity) basins[v] = sets.find(v);
  return basins;
}

std::vector<MergeTree::Class> MergeTree::classes() const {
  std::vector<Class> classes;
  classes.reserve(births.size());
  std::vector<bool> dead(births.size());
  for (const Merge& m : merges) {
    classes.push_back({m.younger_birth, m.value, m.younger, static_cast<Index>(classes.size())});
    dead[static_cast<std::size_t>(m.younger)] = true;
  }
  for (std::size_t v = 0; v < births.size(); ++v)
    if (!dead[v] && births[v] < kInfinity)
      classes.push_back({births[v], kInfinity, static_cast<Index>(v), -1});
  // Merges are in the order of deaths. The sort by birth is stable and therefore keeps that order
  // among equal births.
  radix_sort_by_value(classes, [](const Class& c) { return c.birth + 0.0; });
  for (auto begin = classes.begin(), end = begin; begin != classes.end(); begin = end) {
    end = std::find_if(begin, classes.end(), [&](const Class& c) {
      return c.birth != begin->birth || c.death != begin->death;
    });
    std::sort(begin, end, [](const Class& a, const Class& b) { return a.vertex < b.vertex; });
  }
  return classes;
}

std::vector<Branch> MergeTree::branches() const {
  std::vector<Branch> branches;
  std::vector<Index> place(births.size(), -1);
  for (std::size_t v = 0; v < births.size(); ++v) {
    if (births[v] == kInfinity) continue;
    place[v] = static_cast<Index>(branches.size());
    branches.push_back({births[v], kInfinity, -1});
  }
  const auto place_of = [&](Index vertex) { return place[static_cast<std::size_t>(vertex)]; };
  for (const Merge& m : merges) {
    Branch& younger = branches[static_cast<std::size_t>(place_of(m.younger))];
    younger.death = m.value;
    younger.elder = place_of(m.elder);
  }
  return branches;
}

std::vector<LinkageRow> linkage(const MergeTree& tree) {
  // The cluster of each vertex that gave birth to a cluster.
  std::vector<Index> cluster(tree.births.size());
  std::iota(cluster.begin(), cluster.end(), Index{0});
  std::vector<LinkageRow> rows;
  rows.reserve(tree.merges.size());
  for (const Merge& m : tree.merges) {
    Index& elder = cluster[static_cast<std::size_t>(m.elder)];
    const auto [first, second] = std::minmax({elder, cluster[static_cast<std::size_t>(m.younger)]});
    rows.push_back({first, second, m.value, m.elder_size + m.younger_size});
    elder = tree.size() + static_cast<Index>(rows.size()) - 1;
  }
  return rows;
}

MergeTree merge_tree(const Rips& rips, const RunContext& context) {
  const RipsGraph& graph = rips.graph(detail::form_of_tree(rips), context);
  if (graph.has_names())
    throw Error(ErrorKind::usage,
                "merge tree: found points that are not vertices, because only some vertices are "
                "selected, equal points are merged, or the threshold is below some births "
                "(weights); expected all points as vertices");
  return with_rips_filtration(graph, 0, [&](const auto& f) { return tree_of(f, context); });
}

MergeTree merge_tree(const Cubical& cubical, const RunContext& context) {
  return tree_of(cubical, context);
}

MergeTree merge_tree(const Alpha& alpha, const RunContext& context) {
  if (alpha.is_periodic())
    throw Error(ErrorKind::usage,
                "merge tree: found a periodic space, expected one without periods");
  alpha.prepare(context);
  return tree_of(alpha, context);
}

MergeTree merge_tree(const FilteredGraph& graph, const RunContext& context) {
  return tree_of(graph, context);
}

MergeTree merge_tree(const ExplicitComplex& complex, const RunContext& context) {
  if (!complex.edges_join_vertices()) {
    throw Error(ErrorKind::usage, "a merge tree needs edges that join two vertices");
  }
  MergeTree tree = tree_of(complex, context);
  if (const std::optional<double> largest = complex.threshold()) {
    std::ranges::replace_if(
        tree.births, [&](double birth) { return birth > *largest; }, kInfinity);
    const auto later = std::ranges::upper_bound(tree.merges, *largest, {}, &Merge::value);
    tree.merges.erase(later, tree.merges.end());
  }
  return tree;
}

}  // namespace ph
