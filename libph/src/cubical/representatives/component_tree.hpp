// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libph/src/cubical/graphs/basins.hpp"
#include "libph/src/cubical/graphs/elder_forest.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// Says which items belong to a component when it dies. With `value`, they are the items that enter
/// at a lower value than the death. With `order`, they are the items that enter before the death in
/// the order of the filtration.
enum class Before { value, order };

/// Persistent components in one of a grid's two graphs. Unlike `ComponentPairing`, this class
/// records into which component each component merges. A component is named by the basin of its
/// oldest root.
template <class Graph>
class ComponentTree {
 public:
  struct Merge {
    std::uint32_t bridge;      ///< index into the cells of the bridges
    std::uint32_t dies, into;  ///< basins
  };

  /// @param bridges critical cells; only cells listed in `bridges.order` are used, and bridges that
  /// join components are removed from it.
  ComponentTree(const StarGrid& grid, const Graph& graph, CriticalCells& bridges,
                const RunContext& context)
      : grid_(grid),
        graph_(graph),
        bridges_(bridges.cells),
        basins_(grid, graph, context),
        merges_(&context.memory),
        nodes_(basins_.outer_count() + basins_.roots().size(), &context.memory) {
    join(bridges, context);
  }

  const StarGrid& grid() const { return grid_; }
  const Graph& graph() const { return graph_; }
  std::uint32_t basin_count() const { return static_cast<std::uint32_t>(nodes_.size()); }
  /// The basin of a node. Several threads may call this function at the same time.
  std::uint32_t basin_of(std::uint32_t node) { return basins_.basin_of(node); }
  /// True if a component was always there.
  bool is_outer(std::uint32_t basin) const { return basin < basins_.outer_count(); }
  bool dies(std::uint32_t basin) const { return nodes_[basin].parent != basin; }
  /// The component into which a component merges, or the component itself if it never dies.
  std::uint32_t parent(std::uint32_t basin) const { return nodes_[basin].parent; }
  double death_value(std::uint32_t basin) const { return nodes_[basin].death; }
  /// The merges in the order in which they happen.
  std::span<const Merge> merges() const { return merges_; }

  /// The component that contains an item at the moment when the item enters. On the way up from the
  /// component of the basin, it is the first component that does not die before the item enters.
  std::uint32_t holder(std::uint32_t basin, double value, std::uint32_t voxel,
                       Before before) const {
    const auto holds = [&](std::uint32_t b) {
      const Node& node = nodes_[b];
      if (node.parent == b) return true;
      if (node.death != value) return Graph::kBackwards ? node.death < value : node.death > value;
      if (before == Before::value) return false;
      return Graph::kBackwards ? node.death_voxel <= voxel : node.death_voxel >= voxel;
    };
    while (!holds(basin)) {
      const std::uint32_t far = nodes_[basin].jump;
      basin = holds(far) ? nodes_[basin].parent : far;
    }
    return basin;
  }

  /// The critical cell at the oldest root of a component. Precondition: the component was not
  /// always there.
  StarCell root_cell(std::uint32_t basin) {
    const auto [voxel, number] = basins_.roots()[basin - basins_.outer_count()];
    return {voxel, graph_.root_direction(number), grid_.value(voxel)};
  }
  StarCell bridge_cell(std::uint32_t bridge) const {
    const auto [voxel, number] = bridges_[bridge];
    return {voxel, graph_.bridge_direction(number), grid_.value(voxel)};
  }
  /// The two nodes that a bridge joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t bridge) const {
    return graph_.ends(bridges_[bridge].voxel, bridges_[bridge].number);
  }

 private:
  struct Node {
    double death;
    std::uint32_t death_voxel;
    std::uint32_t parent;  // the basin itself if its component never dies
    // `jump` is an ancestor further up (Myers, An applicative random-access stack, 1983).
    std::uint32_t jump, depth;
  };

  void join(CriticalCells& bridges, const RunContext& context) {
    ElderForest<Graph::kBackwards> forest(
        basins_.outer_count(), basins_.roots().size(),
        [&](std::size_t i) { return grid_.value(basins_.roots()[i].voxel); }, context);
    for (std::uint32_t b = 0; b < nodes_.size(); ++b) nodes_[b] = {0, 0, b, b, 0};
    auto& order = bridges.order;
    Ticker ticker(context, "components", order.size());
    const std::size_t size = order.size();
    const auto place = [size](std::size_t i) { return Graph::kBackwards ? size - 1 - i : i; };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size; ++i) {
      ticker.tick();
      const CriticalCells::Place bridge = order[place(i)];
      const auto [from, to] = ends(bridge.cell);
      const std::uint32_t a = forest.find(basin_of(from)), b = forest.find(basin_of(to));
      if (a == b) {
        order[place(kept++)] = bridge;
        continue;
      }
      const std::uint32_t dies = forest.join(a, b), into = dies == a ? b : a;
      merges_.push_back({bridge.cell, dies, into});
      Node& node = nodes_[dies];
      node.death = bridge.value;
      node.death_voxel = bridges_[bridge.cell].voxel;
      node.parent = into;
    }
    if (Graph::kBackwards)
      order.erase(order.begin(), order.end() - static_cast<std::ptrdiff_t>(kept));
    else
      order.resize(kept);
    for (std::size_t i = merges_.size(); i-- > 0;) {  // components that die later come first
      Node& node = nodes_[merges_[i].dies];
      const Node &up = nodes_[node.parent], &far = nodes_[up.jump];
      node.depth = up.depth + 1;
      node.jump =
          up.depth - far.depth == far.depth - nodes_[far.jump].depth ? far.jump : node.parent;
    }
  }

  const StarGrid& grid_;
  const Graph& graph_;
  const std::pmr::vector<NumberedCell>& bridges_;
  Basins<Graph> basins_;
  std::pmr::vector<Merge> merges_;
  RawVector<Node> nodes_;
};

}  // namespace ph::cubical
