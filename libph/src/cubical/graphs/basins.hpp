// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "libph/src/cubical/graphs/arrow_forest.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {

/// If there are many critical cells, links the nodes along their arrows, except for some nodes at
/// the border. Most arrows will then be needed, and looking them all up in order is faster than
/// looking up each arrow when it is needed.
template <class Graph>
void follow_inner_arrows(const StarGrid& grid, const Graph& graph, ArrowForest<Graph>& forest,
                         const RunContext& context) {
  // Does nothing if at most one in `many` voxels has a critical cell.
  constexpr std::uint32_t many = 256;
  if (grid.critical().size() <= grid.size() / many) return;
  // At the start of a piece, the preceding rows that share cells with it are processed again.
  const std::uint32_t layer = grid.has_axis(0) ? grid.extent(1) : 1;
  const std::uint32_t piece = std::max(16 * layer, (1U << 18) / grid.extent(2));
  for_each_piece("arrows", grid.row_count(), piece, context,
                 [&](std::size_t begin, std::size_t end) {
                   graph.for_each_inner_arrow(
                       static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
                       [&](std::uint32_t node, std::uint32_t to) { forest.link(node, to); });
                 });
}

/// Calls `use(voxel, node, number of the root in the star)` for the roots in all stars, in the
/// order of the grid.
template <class Graph, class Use>
void for_each_root(const StarGrid& grid, const Graph& graph, Ticker& ticker, Use&& use) {
  for (const std::uint32_t v : grid.critical()) {
    ticker.work();
    graph.for_each_root(v, [&](std::uint32_t node, std::uint32_t number) { use(v, node, number); });
  }
}

/// The basins of a graph, which are the trees that its arrows form. Basins are numbered by their
/// roots. The first numbers belong to nodes that were always there, which have no cell. The
/// critical cells follow, in the order of the grid.
template <class Graph>
class Basins {
 public:
  Basins(const StarGrid& grid, const Graph& graph, const RunContext& context)
      : grid_(grid),
        graph_(graph),
        context_(context),
        forest_(graph, context),
        roots_(&context.memory) {
    follow_inner_arrows(grid, graph, forest_, context);
    for (const int part : {0, 1}) forest_.set_root(graph.outside(part), outer_count_++);
    if (graph.has_outer_nodes()) join_outer_nodes();
    Ticker ticker(context, "roots");
    for_each_root(
        grid, graph, ticker, [&](std::uint32_t v, std::uint32_t node, std::uint32_t number) {
          forest_.set_root(node, outer_count_ + static_cast<std::uint32_t>(roots_.size()));
          roots_.push_back({v, number});
        });
  }

  /// The number of roots that were always there.
  std::uint32_t outer_count() const { return outer_count_; }
  /// The critical cells at the roots that were not always there.
  std::pmr::vector<NumberedCell>& roots() { return roots_; }
  /// The basin of a node. Several threads may call this function at the same time.
  std::uint32_t basin_of(std::uint32_t node) { return forest_.number_of_root(forest_.find(node)); }

 private:
  // A voxel that never enters connects nodes that were always there. Joins these nodes.
  void join_outer_nodes() {
    Ticker ticker(context_, "holes", grid_.size());
    for (std::uint32_t v = 0; v < grid_.size(); ++v) {
      ticker.tick();
      if (grid_.enters(v)) continue;
      std::optional<std::uint32_t> root;
      graph_.for_each_outer_node(v, [&](std::uint32_t node) {
        if (!forest_.is_known(node)) return;
        const std::uint32_t own = forest_.find(node);
        if (!root) root = own;
        if (own == *root) return;
        // The root with the lower number stays a root. The two parts of the outside have the lowest
        // numbers.
        const bool is_first = forest_.number_of_root(own) < forest_.number_of_root(*root);
        forest_.link(is_first ? *root : own, is_first ? own : *root);
        if (is_first) root = own;
      });
      graph_.for_each_outer_node(v, [&](std::uint32_t node) {
        if (forest_.is_known(node)) return;
        if (root)
          forest_.link(node, *root);
        else
          forest_.set_root(*(root = node), outer_count_++);
      });
    }
  }

  const StarGrid& grid_;
  const Graph& graph_;
  const RunContext& context_;
  ArrowForest<Graph> forest_;
  std::pmr::vector<NumberedCell> roots_;
  std::uint32_t outer_count_ = 0;
};

}  // namespace ph::cubical
