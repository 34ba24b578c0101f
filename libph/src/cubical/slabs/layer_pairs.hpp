// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <map>
#include <memory_resource>
#include <optional>

#include "libph/src/cubical/layers/layer_grid.hpp"
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/slabs/free_cells.hpp"
#include "libph/src/cubical/slabs/seam_forest.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// In a grid with two axes, finds the edges that neither graph pairs. A torus has two such edges,
/// and their classes never die. The graph of voxels passes on the edges that do not join
/// components. The graph of top cells later visits each of these edges. If an edge joins components
/// there, the edge is in a pair.
class EdgesInNeither {
 public:
  explicit EdgesInNeither(std::pmr::memory_resource* memory) : met_once(memory) {}
  void meet(double value, const GridCell& edge) {
    const auto [at, is_new] = met_once.try_emplace(edge, value);
    if (!is_new) met_once.erase(at);
  }
  void join(const EdgesInNeither& others) {
    for (const auto& [edge, value] : others.met_once) meet(value, edge);
  }

  std::pmr::map<GridCell, double> met_once;
};

/// Computes the pairs of a grid layer by layer, except for the pairs of loops in a grid with three
/// axes. The layers added so far are represented by the components of the two graphs. A pair is
/// passed on as soon as no other layer can change it.
class LayerPairs {
 public:
  /// The graphs that are needed.
  struct Graphs {
    bool vertices, tops;
  };
  /// @param grid the entire grid; it must outlive this object.
  LayerPairs(const GridShape& grid, const Graphs& graphs, const RunContext& context);

  /// Adds the slab right after the layers that have already been added.
  /// @param first the first voxel of the slab in the entire grid, including ghosts (modulo 2^64).
  /// @param free receives the cells of three axes that neither graph pairs; may be null.
  void add(const StarGrid& slab, std::uint64_t first, PairSink& pairs,
           FreeCellSink* free = nullptr);
  /// Adds a slab of more than three axes.
  void add(const LayerGrid& slab, std::uint64_t first, PairSink& pairs);
  /// Joins the layers of `others`, which come right before or right after the layers added so far.
  /// @param free as in `add`, for all layers.
  /// @throws Error (bad_data) if the seams differ; in this case nothing has changed.
  void join(LayerPairs others, bool come_before, PairSink& pairs, FreeCellSink* free = nullptr);
  /// Passes on the cells that neither graph pairs. Must be called after all layers have been added.
  void finish(PairSink& pairs) const;

  bool wants_vertices() const { return graphs_.vertices; }
  bool wants_tops() const { return graphs_.tops; }

  /// True if the layers added so far begin where the grid begins, or end where it ends.
  bool has_begin = false, has_end = false;
  std::optional<SeamForest<false>> vertices;
  std::optional<SeamForest<true>> tops;
  EdgesInNeither around;  ///< used only if both axes are periodic

 private:
  void check_seams(const LayerPairs& others, bool come_before) const;
  bool is_ring() const { return grid_.axis(grid_.layer_axis()).periodic; }
  template <class Forest>
  void take(std::optional<Forest>& all, Forest next, bool comes_before = false);
  /// Adds the part of a graph that is in a slab. @param bridges the bridges of the graph, in the
  /// order of the graph.
  template <class Forest, class Grid, class Graph>
  void take_slab(std::optional<Forest>& all, const Grid& slab, const Graph& graph,
                 const CriticalCells& bridges, std::uint64_t first);
  /// A cell of the grid with its direction, given the number of the cell in a star.
  WholeCell cell(int dim, const GridCell& name, double value) const {
    const auto direction = direction_in_star(grid_.top_dim(), dim, name.number());
    return {name.voxel(), direction.value_or(WideDirection{}), value};
  }
  void settle_vertices(PairSink& pairs, FreeCellSink* free);
  void settle_tops(PairSink& pairs, FreeCellSink* free);

  const GridShape& grid_;
  Graphs graphs_;
  bool may_have_neither_;
  const RunContext& context_;
};

}  // namespace ph::cubical
