// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "libph/src/cubical/graphs/basins.hpp"
#include "libph/src/cubical/slabs/seam_forest.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "ph/detail/components/disjoint_sets.hpp"

namespace ph::cubical {

/// The trees that the arrows form in one slab of a grid. Roots are numbered in the order of
/// SeamForest::roots.
/// @tparam Grid the grid of the graph: a SlabFrame that knows which voxels enter.
template <class Grid, class Graph>
class SlabBasins {
 public:
  /// @param first the first voxel of the slab in the entire grid, including ghosts (modulo 2^64).
  /// @param is_next true if the slab will be joined with the layers directly before it.
  SlabBasins(const Grid& grid, const Graph& graph, std::uint64_t first, bool is_next,
             const RunContext& context)
      : grid_(grid),
        graph_(graph),
        first_(first),
        is_next_(is_next),
        context_(context),
        forest_(graph, context),
        roots_(&context.memory),
        same_(0, &context.memory) {
    follow_inner_arrows(grid, graph, forest_, context);
    for (const std::uint32_t part : {0U, 1U})
      forest_.set_root(graph.outside(static_cast<int>(part)), add({0, {}, Kind::outer}));
    if (graph.has_outer_nodes()) join_outer_nodes();
    if (!Graph::kBackwards) add_critical();
    if (grid.slab().has_ghost_before() && !is_next) add_open(false);
    if (grid.slab().has_ghost_after()) add_open(true);
    if (Graph::kBackwards) add_critical();
    if (is_next) add_open(false);
  }

  /// The components of this slab, before it is joined with other layers.
  /// @param cells the critical cells; the cells in `cells.order` are the bridges of the graph.
  SeamForest<Graph::kBackwards> forest(const CriticalCells& cells) {
    SeamForest<Graph::kBackwards> result(context_);
    result.bridges.resize(cells.order.size());
    constexpr std::size_t piece = 1 << 14;
    for_each_piece(
        "basins", cells.order.size(), piece, context_, [&](std::size_t i, std::size_t end) {
          for (; i < end; ++i) {
            const auto [value, place] = cells.order[i];
            const auto [voxel, number] = cells.cells[place];
            const auto [from, to] = graph_.ends(voxel, number);
            result.bridges[i] = {value, {voxel + first_, number}, number_of(from), number_of(to)};
          }
        });
    for (SeamBridge& bridge : result.bridges) {
      bridge.from = same_.find(bridge.from);
      bridge.to = same_.find(bridge.to);
    }
    if (grid_.slab().has_ghost_before()) result.before = seam(false, !is_next_);
    if (grid_.slab().has_ghost_after()) result.after = seam(true, true);
    result.outside = {same_.find(0), same_.find(1)};
    result.resolved = resolved_;
    result.roots = std::move(roots_);
    return result;
  }

 private:
  using Kind = SeamRoot::Kind;

  // The number of the root of a node's tree. Several threads may call this function at the same
  // time.
  std::uint32_t number_of(std::uint32_t node) { return forest_.number_of_root(forest_.find(node)); }
  std::uint32_t add(const SeamRoot& root) {
    roots_.push_back(root);
    return same_.add();
  }
  // Unites two roots that were always there; the root with the lower number remains a root.
  void unite(std::uint32_t a, std::uint32_t b) {
    a = same_.find(a);
    b = same_.find(b);
    if (a != b) same_.link(std::max(a, b), std::min(a, b));
  }
  void join_outer_nodes() {
    Ticker ticker(context_, "holes", grid_.size());
    for (std::uint32_t v = 0; v < grid_.size(); ++v) {
      ticker.tick();
      if (grid_.enters(v) || grid_.is_ghost(v)) continue;
      std::optional<std::uint32_t> root;
      graph_.for_each_outer_node(v, [&](std::uint32_t node) {
        if (!forest_.is_known(node)) return;
        if (root) unite(*root, number_of(node));
        root = number_of(node);
      });
      graph_.for_each_outer_node(v, [&](std::uint32_t node) {
        if (forest_.is_known(node)) return;
        if (!root) root = add({0, {}, Kind::outer});
        forest_.set_root(node, *root);
      });
    }
  }
  void add_critical() {
    Ticker ticker(context_, {});
    for_each_root(
        grid_, graph_, ticker, [&](std::uint32_t v, std::uint32_t node, std::uint32_t number) {
          forest_.set_root(node, add({grid_.value(v), {v + first_, number}, Kind::critical}));
        });
  }
  void add_open(bool after) {
    const auto [begin, count] = graph_.seam(after);
    const Kind kind = after ? Kind::open_after : Kind::open_before;
    const bool is_stored = after || !is_next_;
    const auto is_known = [&](std::uint32_t node) {
      return forest_.is_known(node) || graph_.is_known_here(node);
    };
    std::size_t most = 0;
    for (std::uint32_t k = 0; is_stored && k < count; ++k) most += is_known(begin + k) ? 0 : 1;
    roots_.reserve(roots_.size() + most);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t node = begin + k;
      if (is_known(node)) continue;
      const auto value = graph_.seam_value(node);
      if (!value) continue;
      if (!is_stored) ++resolved_;
      forest_.set_root(node, is_stored ? add({*value, {}, kind}) : same_.add());
    }
  }
  // The nodes that the slab shares with the layers before it or after it.
  Seam seam(bool after, bool with_values) {
    const auto [begin, count] = graph_.seam(after);
    Seam seam(&context_.memory);
    seam.roots.assign(count, Seam::kNone);
    if (with_values) seam.values.assign(count, 0);
    for (std::uint32_t k = 0; k < count; ++k)
      if (const auto value = graph_.seam_value(begin + k)) {
        seam.roots[k] = same_.find(number_of(begin + k));
        if (with_values) seam.values[k] = *value;
      }
    return seam;
  }

  const Grid& grid_;
  const Graph& graph_;
  const std::uint64_t first_;
  const bool is_next_;
  const RunContext& context_;
  ArrowForest<Graph> forest_;
  std::pmr::vector<SeamRoot> roots_;
  std::uint32_t resolved_ = 0;  // the number of resolved roots, which are numbered after the others
  DisjointSets same_;           // the sets of roots
};

}  // namespace ph::cubical
