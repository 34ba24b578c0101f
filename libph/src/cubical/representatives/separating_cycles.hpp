// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "libph/src/cubical/columns/voxel_chain.hpp"
#include "libph/src/cubical/graphs/top_graph.hpp"
#include "libph/src/cubical/graphs/voxel_graph.hpp"
#include "libph/src/cubical/representatives/component_tree.hpp"
#include "libph/src/cubical/representatives/nested_sets.hpp"

namespace ph::cubical {

/// The top cells of the input, with their facets. The top cells are nodes in one of the two graphs.
class InputTopCells {
 public:
  explicit InputTopCells(const StarGrid& grid) : grid_(grid) {
    for (int a = 0; a < 3; ++a)
      if (grid.has_axis(a)) up_[a] = 1;
  }
  /// The number of voxels. In T, the top cells are voxels. In V, a top cell has the number of its
  /// first voxel; a voxel at the upper end of an axis is not the first voxel of any top cell.
  std::uint32_t count() const { return grid_.size(); }

  /// The component that contains a top cell when the cell enters; kNone if no top cell has the
  /// number `node`.
  std::uint32_t holder(ComponentTree<TopGraph>& tree, std::uint32_t node) const {
    for (int a = 0; a < 3; ++a)
      if (up_[a] != 0 && grid_.step(node, a, 1) == StarGrid::kOutside) return NestedSets::kNone;
    const std::uint32_t basin = tree.basin_of(node);
    const StarCell top = tree.graph().cell(node);
    // A cell that never enters has no place in the order, because it was always there.
    if (top.direction == Direction{}) return basin;
    return tree.holder(basin, grid_.value(top.voxel), top.voxel, Before::order);
  }
  std::uint32_t holder(ComponentTree<VoxelGraph>& tree, std::uint32_t node) const {
    return tree.holder(tree.basin_of(node), grid_.value(node), node, Before::order);
  }

  /// Calls `use(facet, node on the other side of the facet, true if the incidence is 1)` for each
  /// facet of a top cell.
  template <class Use>
  void for_each_facet(const TopGraph& graph, std::uint32_t node, Use&& use) const {
    for (int a = 0; a < 3; ++a) {
      if (up_[a] == 0) continue;
      use(StarCell{node, turned(up_, a, 0), 0}, graph.node(node, turned(up_, a, -1)), is_odd(a));
      const std::uint32_t next = grid_.step(node, a, 1);
      use(StarCell{next, turned(up_, a, 0), 0}, graph.node(next, up_), !is_odd(a));
    }
  }
  template <class Use>
  void for_each_facet(const VoxelGraph& graph, std::uint32_t node, Use&& use) const {
    for (int e = 0; e < kEdgeCount; ++e) {
      const int a = axis_of_edge(e);
      if (up_[a] == 0) continue;
      // Here the axes of the input run backwards.
      use(StarCell{node, kEdges[e], 0}, graph.ends(node, static_cast<std::uint32_t>(e))[1],
          (kEdges[e][a] < 0) != is_odd(a));
    }
  }
  StarCell cell(const TopGraph&, std::uint32_t node) const { return {node, up_, 0}; }
  StarCell cell(const VoxelGraph&, std::uint32_t node) const { return {node, {}, 0}; }

 private:
  bool is_odd(int axis) const { return (axis - (3 - grid_.top_dim())) % 2 != 0; }

  const StarGrid& grid_;
  Direction up_{};
};

/// Cycles of the second highest dimension. The cycle of a component of the dual graph separates the
/// component, at its death, from all other top cells.
template <class Graph, Field K>
class SeparatingCycles {
 public:
  SeparatingCycles(ComponentTree<Graph>& tree, const K& field, const RunContext& context)
      : tree_(tree),
        field_(field),
        context_(context),
        cells_(tree.grid()),
        sets_(
            tree, Before::order, cells_.count(),
            [&](std::uint32_t node) { return cells_.holder(tree_, node); },
            [](std::uint32_t node) { return node; }, context) {}

  /// Appends the cycle of a component that dies.
  void append(std::uint32_t basin, VoxelChain<K>& chain) {
    Ticker ticker(context_, {});
    for (const std::uint32_t node : sets_.set(basin)) {
      ticker.work();
      cells_.for_each_facet(tree_.graph(), node,
                            [&](const StarCell& facet, std::uint32_t beyond, bool is_positive) {
                              if (!is_in(basin, beyond))
                                chain.emplace_back(facet, signed_one(field_, is_positive));
                            });
    }
    if (basin != kUpperOutside) return;
    // The component contains a part of the outside. It therefore also contains the top cells at the
    // border of this part.
    for (std::uint32_t node = 0; node < cells_.count(); ++node) {
      ticker.work();
      if (cells_.holder(tree_, node) == NestedSets::kNone || sets_.contains(basin, node)) continue;
      cells_.for_each_facet(tree_.graph(), node,
                            [&](const StarCell& facet, std::uint32_t beyond, bool is_positive) {
                              if (beyond == tree_.graph().outside(1))
                                chain.emplace_back(facet, signed_one(field_, !is_positive));
                            });
    }
  }
  /// Appends the top cells of a component that never dies.
  void append_all(std::uint32_t basin, VoxelChain<K>& chain) const {
    for (const std::uint32_t node : sets_.set(basin))
      chain.emplace_back(cells_.cell(tree_.graph(), node), field_.from_int(1));
  }

 private:
  static constexpr std::uint32_t kUpperOutside = 1;  // the basin of the upper part of the outside
  bool is_in(std::uint32_t basin, std::uint32_t node) const {
    if (node >= tree_.graph().outside(0))
      return basin == kUpperOutside && node == tree_.graph().outside(1);
    return sets_.contains(basin, node);
  }

  ComponentTree<Graph>& tree_;
  const K& field_;
  const RunContext& context_;
  const InputTopCells cells_;
  NestedSets sets_;
};

}  // namespace ph::cubical
