// SPDX-License-Identifier: MIT
#include "two_graphs.hpp"

#include <algorithm>

#include "pair_components.hpp"
#include "top_graph.hpp"
#include "voxel_graph.hpp"

namespace ph::cubical {
namespace {

void mark_edge(StarGrid& grid, const Bridge& bridge) {
  const std::uint32_t v = bridge.voxel;
  grid.mark(v, grid.tables(v).taken_mark(static_cast<int>(bridge.number)));
}

/// The cells that roots and bridges of a graph are.
template <class Graph>
StarCell cell_of(const Graph& graph, const Root& root) {
  return {root.voxel, graph.root_direction(root.number), root.value};
}
template <class Graph>
StarCell cell_of(const Graph& graph, const Bridge& bridge) {
  return {bridge.voxel, graph.bridge_direction(bridge.number), bridge.value};
}

}  // namespace

void pair_vertices_with_edges(StarGrid& grid, const RunContext& context, const PairSink& sink) {
  const VoxelGraph graph(grid);
  const bool wants_loops = grid.top_dim() == 1;
  pair_components(
      grid, graph, wants_loops, context,
      [&](const Bridge& bridge, const Root* dies) {
        if (grid.wants_marks()) mark_edge(grid, bridge);
        if (dies == nullptr)
          sink.essential(1, cell_of(graph, bridge));
        else if (dies->value != bridge.value)
          sink.pair(0, cell_of(graph, *dies), cell_of(graph, bridge));
      },
      [&](const Bridge& bridge) {
        if (wants_loops) sink.essential(1, cell_of(graph, bridge));
      },
      [&](const Root& root) { sink.essential(0, cell_of(graph, root)); });
}

TakenSquares pair_facets_with_top_cells(StarGrid& grid, const RunContext& context,
                                        const PairSink& sink) {
  const int top = grid.top_dim();
  const TopGraph graph(grid);
  TakenSquares taken(top == 3 ? grid.critical().size() : 0, 0, &context.memory);
  pair_components(
      grid, graph, false, context,
      [&](const Bridge& bridge, const Root* dies) {
        if (top == 3) {
          const auto critical = grid.critical();
          const auto at = std::ranges::lower_bound(critical, bridge.voxel);
          taken[static_cast<std::size_t>(at - critical.begin())] |=
              static_cast<std::uint16_t>(1U << bridge.number);
        } else if (grid.wants_marks()) {
          mark_edge(grid, bridge);
        }
        if (dies == nullptr)
          sink.essential(top - 1, cell_of(graph, bridge));
        else if (dies->value != bridge.value)
          sink.pair(top - 1, cell_of(graph, bridge), cell_of(graph, *dies));
      },
      [](const Bridge&) {}, [&](const Root& root) { sink.essential(top, cell_of(graph, root)); });
  return taken;
}

}  // namespace ph::cubical
