// SPDX-License-Identifier: MIT
#include "libph/src/cubical/graphs/two_graphs.hpp"

#include "libph/src/cubical/graphs/pair_components.hpp"
#include "libph/src/cubical/graphs/top_graph.hpp"
#include "libph/src/cubical/graphs/voxel_graph.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {
namespace {

using Place = CriticalCells::Place;

class VertexPairing {
 public:
  VertexPairing(const StarGrid& grid, CriticalCells& edges, bool wants_cells,
                const RunContext& context)
      : graph_(grid), pairing_(grid, graph_, edges, wants_cells, context) {}

  std::size_t most_pairs() const { return pairing_.most_pairs(); }
  void run(PairSink& sink) {
    pairing_.run(
        [&](const Place& edge, const Place* dies) {
          if (dies == nullptr)
            sink.essential(1, pairing_.bridge_cell(edge));
          else
            sink.pair(0, pairing_.root_cell(*dies), pairing_.bridge_cell(edge));
        },
        [&](const Place& root) { sink.essential(0, pairing_.root_cell(root)); });
  }

 private:
  VoxelGraph graph_;
  ComponentPairing<VoxelGraph> pairing_;
};

class TopCellPairing {
 public:
  TopCellPairing(const StarGrid& grid, CriticalCells& facets, bool wants_cells,
                 const RunContext& context)
      : top_(grid.top_dim()), graph_(grid), pairing_(grid, graph_, facets, wants_cells, context) {}

  std::size_t most_pairs() const { return pairing_.most_pairs(); }
  void run(PairSink& sink) {
    pairing_.run(
        [&](const Place& facet, const Place* dies) {
          if (dies == nullptr)
            sink.essential(top_ - 1, pairing_.bridge_cell(facet));
          else
            sink.pair(top_ - 1, pairing_.bridge_cell(facet), pairing_.root_cell(*dies));
        },
        [&](const Place& root) { sink.essential(top_, pairing_.root_cell(root)); });
  }

 private:
  int top_;
  TopGraph graph_;
  ComponentPairing<TopGraph> pairing_;
};

}  // namespace

void pair_vertices_with_edges(const StarGrid& grid, CriticalCells& edges, const RunContext& context,
                              PairSink& sink) {
  VertexPairing pairing(grid, edges, sink.wants_cells(), context);
  sink.expect(pairing.most_pairs());
  pairing.run(sink);
}

void pair_facets_with_top_cells(const StarGrid& grid, CriticalCells& facets,
                                const RunContext& context, PairSink& sink) {
  TopCellPairing pairing(grid, facets, sink.wants_cells(), context);
  sink.expect(pairing.most_pairs());
  pairing.run(sink);
}

void pair_in_both_graphs(const StarGrid& grid, CriticalCells& edges, CriticalCells& squares,
                         const RunContext& context, PairSink& sink, PairSink& top_sink) {
  // The basins of the two graphs are found one after the other, because each search uses all
  // threads, and temporarily uses four bytes per voxel.
  VertexPairing vertices(grid, edges, sink.wants_cells(), context);
  TopCellPairing top_cells(grid, squares, sink.wants_cells(), context);
  sink.expect(vertices.most_pairs() + top_cells.most_pairs());
  for_each_piece("components", 2, tasks_at_a_time(grid), context,
                 [&](std::size_t i, std::size_t end) {
                   for (; i < end; ++i) i == 0 ? vertices.run(sink) : top_cells.run(top_sink);
                 });
}

}  // namespace ph::cubical
