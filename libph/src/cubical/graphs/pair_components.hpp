// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "libph/src/cubical/graphs/basins.hpp"
#include "libph/src/cubical/graphs/elder_forest.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// Finds the persistent components in one of a grid's two graphs. Critical cells (*bridges*) join
/// the basins of the graph in the order of the filtration, or in reverse order (Kruskal's algorithm
/// with the elder rule).
template <class Graph>
class ComponentPairing {
 public:
  using Place = CriticalCells::Place;

  /// @param bridges critical cells; only the cells listed in `bridges.order` are used.
  /// @param wants_cells if false, `root_cell` and `bridge_cell` look up only the value of a cell,
  /// not its direction.
  ComponentPairing(const StarGrid& grid, const Graph& graph, CriticalCells& bridges,
                   bool wants_cells, const RunContext& context)
      : grid_(grid),
        graph_(graph),
        bridges_(bridges),
        wants_cells_(wants_cells),
        context_(context),
        ends_(bridges.cells.size(), &context.memory),
        roots_(&context.memory) {
    find_basins();
  }

  /// An upper bound for the number of bars that `run` finds.
  std::size_t most_pairs() const { return std::min(bridges_.order.size(), roots_.size()) + 2; }
  /// Joins components, and removes the bridges that join them from the order of the bridges.
  /// @param on_merge called with (bridge, root that dies); the root is null if both components were
  /// always there.
  /// @param on_survivor called with each root that never dies.
  template <class OnMerge, class OnSurvivor>
  void run(OnMerge&& on_merge, OnSurvivor&& on_survivor) {
    ElderForest<Graph::kBackwards> forest(
        outer_count_, roots_.size(), [&](std::size_t i) { return grid_.value(roots_[i].voxel); },
        context_);
    const auto root = [&](std::uint32_t basin) {
      return Place{forest.value(basin), basin - outer_count_};
    };
    auto& order = bridges_.order;
    const std::size_t size = order.size();
    const auto place = [size](std::size_t i) { return Graph::kBackwards ? size - 1 - i : i; };
    // The data are at random places in memory. They are prefetched in three steps, well before use.
    constexpr std::size_t stride = 8, ring_size = 4 * stride;
    std::array<Ends, ring_size> ring{};
    const auto is_in = [size](std::size_t i, std::size_t late) {
      return i >= late && i - late < size;
    };
    Ticker ticker(context_, {});
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size + 3 * stride; ++i) {
      if (is_in(i, 0)) __builtin_prefetch(&ends_[order[place(i)].cell]);
      if (is_in(i, stride)) {
        Ends& ends = ring[(i - stride) % ring_size];
        ends = ends_[order[place(i - stride)].cell];
        for (const std::uint32_t end : ends) forest.prefetch(end);
      }
      if (is_in(i, 2 * stride))
        for (std::uint32_t& end : ring[(i - 2 * stride) % ring_size])
          forest.prefetch(end = forest.parent(end));
      if (!is_in(i, 3 * stride)) continue;
      ticker.work();
      const Place bridge = order[place(i - 3 * stride)];
      const auto [from, to] = ring[(i - 3 * stride) % ring_size];
      const std::uint32_t a = forest.find(from), b = forest.find(to);
      if (a == b) {
        order[place(kept++)] = bridge;
        continue;
      }
      const std::uint32_t dies = forest.join(a, b);
      if (dies < outer_count_) {
        on_merge(bridge, nullptr);
      } else {
        const Place dead = root(dies);
        on_merge(bridge, &dead);
      }
    }
    if (Graph::kBackwards)
      order.erase(order.begin(), order.end() - static_cast<std::ptrdiff_t>(kept));
    else
      order.resize(kept);
    for (std::uint32_t i = outer_count_; i < outer_count_ + roots_.size(); ++i)
      if (forest.is_root(i)) on_survivor(root(i));
  }

  StarCell root_cell(const Place& root) const {
    if (!wants_cells_) return {.value = root.value};
    const auto [voxel, number] = roots_[root.cell];
    return {voxel, graph_.root_direction(number), root.value};
  }
  StarCell bridge_cell(const Place& bridge) const {
    if (!wants_cells_) return {.value = bridge.value};
    const auto [voxel, number] = bridges_.cells[bridge.cell];
    return {voxel, graph_.bridge_direction(number), bridge.value};
  }

 private:
  using Ends = std::array<std::uint32_t, 2>;

  // Finds the basins that each bridge joins, in the order of the grid, where neighbours are close
  // in memory.
  void find_basins() {
    Basins<Graph> basins(grid_, graph_, context_);
    std::pmr::vector<bool> is_bridge(ends_.size(), false, &context_.memory);
    for (const Place& place : bridges_.order) is_bridge[place.cell] = true;
    constexpr std::size_t piece = 1 << 14;
    for_each_piece("basins", ends_.size(), piece, context_, [&](std::size_t i, std::size_t end) {
      for (; i < end; ++i) {
        if (!is_bridge[i]) continue;
        const auto [voxel, number] = bridges_.cells[i];
        const auto [a, b] = graph_.ends(voxel, number);
        ends_[i] = {basins.basin_of(a), basins.basin_of(b)};
      }
    });
    outer_count_ = basins.outer_count();
    roots_ = std::move(basins.roots());
  }

  const StarGrid& grid_;
  const Graph& graph_;
  CriticalCells& bridges_;
  const bool wants_cells_;
  const RunContext& context_;
  RawVector<Ends> ends_;
  std::pmr::vector<NumberedCell> roots_;
  // The number of basins that were always there; every other basin has a root in `roots_`.
  std::uint32_t outer_count_ = 0;
};

}  // namespace ph::cubical
