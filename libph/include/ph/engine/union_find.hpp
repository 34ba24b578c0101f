// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/core/barcode.hpp"
#include "ph/core/error.hpp"
#include "ph/core/field.hpp"
#include "ph/engine/engine.hpp"
#include "ph/engine/one_skeleton.hpp"

namespace ph {

/// Whether H0 of a filtration can be computed by union-find.
template <Filtration F>
bool is_graph_like(const F& f) {
  if constexpr (GraphFiltration<F>)
    return f.edges_join_vertices();
  else
    return false;
}

/// Reports the pairs of H0. @return the edges that killed a component.
template <GraphFiltration F>
CellMap<F> pair_components(const F& f, BarcodeBuilder<F>& bars, const RunContext& context) {
  const OneSkeleton<F> graph(f, context);
  std::vector<bool> lives(graph.vertices.size(), true);
  CellMap<F> killers(f, &context.memory);
  join_by_elder_rule(graph.age, graph.ends, context,
                     [&](std::size_t edge, std::uint32_t, std::uint32_t younger) {
                       lives[younger] = false;
                       killers.insert(graph.edges[edge], younger);
                       bars.add_pair(0, graph.vertices[younger], graph.edges[edge]);
                     });
  for (std::size_t v = 0; v < lives.size(); ++v)
    if (lives[v]) bars.add_essential(0, graph.vertices[v]);
  return killers;
}

/// H0 by union-find with the elder rule. See merge_tree.hpp for the whole tree.
struct UnionFindEngine {
  static constexpr Engine id = Engine::union_find;
  static constexpr const char* name = "union_find";
  template <Filtration F>
  static bool can_run(const F& f, int max_dim, Representatives wanted = Representatives::none) {
    return max_dim == 0 && wanted == Representatives::none && is_graph_like(f);
  }

  template <Filtration F, Field K>
  static void run(const F& f, const K&, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (GraphFiltration<F>) pair_components(f, bars, context);
  }
};

}  // namespace ph
