// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "arrow_forest.hpp"
#include "merge_labels.hpp"
#include "ph/core/disjoint_sets.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// Labels what has always been there, besides the outside, and unites what hangs together.
template <class Graph>
void label_endless(const StarGrid& grid, const Graph& graph, ArrowForest<Graph>& forest,
                   DisjointSets& sets, const RunContext& context) {
  Ticker ticker(context, "holes", grid.size());
  for (std::uint32_t v = 0; v < grid.size(); ++v) {
    ticker.tick();
    if (grid.enters(v)) continue;
    // The label of any of them will do for those that have none.
    std::optional<std::uint32_t> label;
    graph.for_each_endless(v, [&](std::uint32_t node) {
      if (!forest.has_label(node)) return;
      const std::uint32_t own = forest.label(node, ticker);
      if (label) sets.unite(own, *label);
      label = own;
    });
    if (!label) {
      label = static_cast<std::uint32_t>(sets.size());
      sets.grow(1);
    }
    graph.for_each_endless(v, [&](std::uint32_t node) {
      if (!forest.has_label(node)) forest.set_label(node, *label);
    });
  }
}

/// Persistent components of one of the two graphs of a grid: what its arrows lead to, joined by its
/// bridges.
/// @param keeps_loops whether `on_loop` is to hear of bridges whose ends are one from the start.
/// For the calls see LabelMerger::run.
template <class Graph, class OnMerge, class OnLoop, class OnSurvivor>
void pair_components(const StarGrid& grid, const Graph& graph, bool keeps_loops,
                     const RunContext& context, OnMerge&& on_merge, OnLoop&& on_loop,
                     OnSurvivor&& on_survivor) {
  std::pmr::memory_resource* const memory = &context.memory;
  Ticker ticker(context, "basins", 2 * grid.critical().size());
  ArrowForest<Graph> forest(graph, memory);
  constexpr std::uint32_t many = 16;  // of so many voxels one has a critical cell: paths meet soon
  if (grid.critical().size() > grid.size() / many) forest.follow_all(ticker);
  DisjointSets sets(2, memory);
  for (const int part : {0, 1})
    forest.set_label(graph.outside(part), static_cast<std::uint32_t>(part));
  if (graph.has_endless()) label_endless(grid, graph, forest, sets, context);

  const auto endless = static_cast<std::uint32_t>(sets.size());
  std::pmr::vector<Root> roots(memory);
  for (const std::uint32_t v : grid.critical()) {
    ticker.tick();
    graph.for_each_root(v, [&](std::uint32_t node, std::uint32_t number) {
      forest.set_label(node, endless + static_cast<std::uint32_t>(roots.size()));
      roots.push_back({grid.value(v), v, number});
    });
  }
  sets.grow(roots.size());
  std::pmr::vector<Bridge> bridges(memory);
  for (const std::uint32_t v : grid.critical()) {
    ticker.tick();
    graph.for_each_bridge(v, [&](std::uint32_t node_a, std::uint32_t node_b, std::uint32_t number) {
      const std::uint32_t a = forest.label(node_a, ticker), b = forest.label(node_b, ticker);
      if (a != b || keeps_loops) bridges.push_back({grid.value(v), a, b, v, number});
    });
  }
  LabelMerger(std::move(sets), endless, roots, bridges, Graph::kBackwards, context)
      .run(on_merge, on_loop, on_survivor);
}

}  // namespace ph::cubical
