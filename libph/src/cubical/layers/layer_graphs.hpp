// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "libph/src/cubical/graphs/arrow_forest.hpp"
#include "libph/src/cubical/graphs/top_nodes.hpp"
#include "libph/src/cubical/graphs/voxel_nodes.hpp"
#include "libph/src/cubical/layers/layer_grid.hpp"
#include "libph/src/cubical/layers/star_links.hpp"
#include "libph/src/cubical/layers/star_numbers.hpp"

namespace ph::cubical {

using LayerVoxels = VoxelNodes<LayerGrid>;
using LayerTops = TopNodes<LayerGrid, GridShape::kMostAxes>;

// The two graphs (VoxelGraph, TopGraph) for any number of axes. The cells of the dimensions between
// the two graphs are not paired. Bridges whose two ends are already connected around one voxel are
// left out. All other bridges are used.

/// Voxels joined by edges. Memory: 4 bytes per voxel, plus roots and bridges.
class LayerVoxelGraph : public LayerVoxels {
 public:
  LayerVoxelGraph(const LayerGrid& grid, const RunContext& context);

  const StarLinks& links() const { return links_; }
  std::uint32_t arrow(std::uint32_t v) const { return links_.arrows[v]; }
  /// The two nodes that an edge in a voxel's star joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t v, std::uint32_t number) const;

 private:
  StarLinks links_;
};

/// Top cells joined by facets. Memory: 4 bytes per voxel, plus roots and bridges.
class LayerTopGraph : public LayerTops {
 public:
  LayerTopGraph(const LayerGrid& grid, const RunContext& context);

  const StarLinks& links() const { return links_; }
  std::uint32_t arrow(std::uint32_t node) const { return links_.arrows[node]; }
  bool is_known_here(std::uint32_t node) const {
    return links_.arrows[node] != StarLinks::kUnknown;
  }
  /// The two nodes that a facet in the star of a voxel joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t v, std::uint32_t number) const;

 private:
  StarLinks links_;
};

/// Does nothing, because all arrows of these graphs are already known.
template <class Graph>
void follow_inner_arrows(const LayerGrid&, const Graph&, ArrowForest<Graph>&, const RunContext&) {}

/// Calls `use(voxel, node, number of the root in the star)` for the roots in all stars, in the
/// order of the grid.
template <class Graph, class Use>
void for_each_root(const LayerGrid&, const Graph& graph, Ticker& ticker, Use&& use) {
  for (const StarLinks::Root& root : graph.links().roots) {
    ticker.work();
    use(root.voxel, root.node, root.number);
  }
}

}  // namespace ph::cubical
