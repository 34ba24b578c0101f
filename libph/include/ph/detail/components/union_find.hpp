// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <memory_resource>
#include <vector>

#include "ph/detail/components/component_representatives.hpp"
#include "ph/detail/components/one_skeleton.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/error.hpp"

namespace ph {

/// True if union-find can compute H0 of a filtration.
template <Filtration F>
bool is_graph_like(const F& f) {
  if constexpr (GraphFiltration<F>)
    return f.edges_join_vertices();
  else
    return false;
}

/// Reports the pairs of H0, with representatives if they are wanted.
/// @param on_killer called with each edge that kills a component.
template <GraphFiltration F, Field K, class OnKiller>
void join_components(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context,
                     OnKiller&& on_killer) {
  const OneSkeleton<F> graph(f, context);
  std::vector<bool> lives(graph.vertices.size(), true);
  ComponentRepresentatives representatives(lives.size(), field, bars, &context.memory);
  const auto cell_of = [&](std::uint32_t v) { return graph.vertices[v]; };
  join_by_elder_rule(graph.age, graph.ends, context,
                     [&](std::size_t edge, std::uint32_t elder, std::uint32_t younger) {
                       lives[younger] = false;
                       on_killer(graph.edges[edge]);
                       if (bars.add_pair(0, graph.vertices[younger], graph.edges[edge]))
                         representatives.give(younger, elder, cell_of);
                       representatives.join(elder, younger);
                     });
  for (std::uint32_t v = 0; v < lives.size(); ++v)
    if (lives[v] && bars.add_essential(0, graph.vertices[v]))
      representatives.give(v, std::nullopt, cell_of);
}

/// H0 by union-find with the elder rule. See merge_tree.hpp for the entire tree.
struct UnionFindEngine {
  static constexpr Engine id = Engine::union_find;
  static constexpr std::array rips_forms{RipsForm::forest, RipsForm::edges};
  template <Filtration F>
  static bool can_run(const F& f, const Task& task) {
    return task.max_dim == 0 && is_graph_like(f) && task.wants_no_sets();
  }
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    return {5, "only components are requested"};
  }
  static constexpr int listed_dim(int) { return 1; }
  static constexpr bool goes_by_edges = true;
  static double rips_bytes(std::size_t vertices, std::size_t) {
    return 16 * static_cast<double>(vertices);
  }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (GraphFiltration<F>) join_components(f, field, bars, context, [](const auto&) {});
  }
};

}  // namespace ph
