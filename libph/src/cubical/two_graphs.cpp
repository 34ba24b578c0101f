// SPDX-License-Identifier: MIT
#include "two_graphs.hpp"

#include "ph/core/radix_sort.hpp"
#include "top_graph.hpp"
#include "voxel_graph.hpp"

namespace ph::cubical {
namespace {

/// What roots are in a graph, and what bridges are.
template <class Graph>
StarCell root_cell(const Graph& graph, const NumberedCell& root) {
  return {root.voxel, graph.root_direction(root.number), root.value};
}
template <class Graph>
StarCell bridge_cell(const Graph& graph, const NumberedCell& bridge) {
  return {bridge.voxel, graph.bridge_direction(bridge.number), bridge.value};
}

}  // namespace

NumberedCells critical_cells(const StarGrid& grid, int dim, const RunContext& context) {
  NumberedCells cells(&context.memory);
  Ticker ticker(context, "critical cells", grid.critical().size());
  for (const std::uint32_t v : grid.critical()) {
    ticker.tick();
    const std::uint32_t star = grid.star(v);
    const StarTables& tables = grid.tables(v);
    const auto add = [&](int number) {
      cells.push_back({grid.value(v), v, static_cast<std::uint32_t>(number)});
    };
    if (dim == 1)
      for_each_in_order(
          tables.critical_edges(star), kEdgeCount, [&](int rank) { return tables.edge_at(rank); },
          add);
    else
      for_each_in_order(
          tables.critical_squares(star, grid.pair_cubes(v)), kSquareCount,
          [&](int rank) { return tables.square_at(rank); }, add);
  }
  radix_sort_by_value(
      cells, [](const NumberedCell& cell) { return cell.value; }, context);
  return cells;
}

void pair_vertices_with_edges(StarGrid& grid, NumberedCells& edges, const RunContext& context,
                              const PairSink& sink) {
  const VoxelGraph graph(grid);
  ComponentPairing(grid, graph, context)
      .run(
          edges,
          [&](const NumberedCell& edge, const NumberedCell* dies) {
            if (grid.top_dim() == 3) {
              const StarTables& tables = grid.tables(edge.voxel);
              grid.mark(edge.voxel, tables.taken_mark(static_cast<int>(edge.number)));
            }
            if (dies == nullptr)
              sink.essential(1, bridge_cell(graph, edge));
            else if (dies->value != edge.value)
              sink.pair(0, root_cell(graph, *dies), bridge_cell(graph, edge));
          },
          [&](const NumberedCell& root) { sink.essential(0, root_cell(graph, root)); });
}

void pair_facets_with_top_cells(const StarGrid& grid, NumberedCells& facets,
                                const RunContext& context, const PairSink& sink) {
  const int top = grid.top_dim();
  const TopGraph graph(grid);
  ComponentPairing(grid, graph, context)
      .run(
          facets,
          [&](const NumberedCell& facet, const NumberedCell* dies) {
            if (dies == nullptr)
              sink.essential(top - 1, bridge_cell(graph, facet));
            else if (dies->value != facet.value)
              sink.pair(top - 1, bridge_cell(graph, facet), root_cell(graph, *dies));
          },
          [&](const NumberedCell& root) { sink.essential(top, root_cell(graph, root)); });
}

}  // namespace ph::cubical
