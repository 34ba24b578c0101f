// SPDX-License-Identifier: MIT
#include "two_graphs.hpp"

#include "pair_components.hpp"
#include "top_graph.hpp"
#include "voxel_graph.hpp"

namespace ph::cubical {

void pair_vertices_with_edges(StarGrid& grid, CriticalCells& edges, const RunContext& context,
                              PairSink& sink) {
  using Place = CriticalCells::Place;
  const VoxelGraph graph(grid);
  ComponentPairing pairing(grid, graph, edges, sink.wants_cells(), context);
  sink.expect(pairing.most_pairs());
  pairing.run(
      [&](const Place& edge, const Place* dies) {
        if (grid.top_dim() == 3) {
          const auto [v, number] = edges.cells[edge.cell];
          grid.mark(v, grid.tables(v).taken_mark(static_cast<int>(number)));
        }
        if (dies == nullptr)
          sink.essential(1, pairing.bridge_cell(edge));
        else
          sink.pair(0, pairing.root_cell(*dies), pairing.bridge_cell(edge));
      },
      [&](const Place& root) { sink.essential(0, pairing.root_cell(root)); });
}

void pair_facets_with_top_cells(const StarGrid& grid, CriticalCells& facets,
                                const RunContext& context, PairSink& sink) {
  using Place = CriticalCells::Place;
  const int top = grid.top_dim();
  const TopGraph graph(grid);
  ComponentPairing pairing(grid, graph, facets, sink.wants_cells(), context);
  sink.expect(pairing.most_pairs());
  pairing.run(
      [&](const Place& facet, const Place* dies) {
        if (dies == nullptr)
          sink.essential(top - 1, pairing.bridge_cell(facet));
        else
          sink.pair(top - 1, pairing.bridge_cell(facet), pairing.root_cell(*dies));
      },
      [&](const Place& root) { sink.essential(top, pairing.root_cell(root)); });
}

}  // namespace ph::cubical
