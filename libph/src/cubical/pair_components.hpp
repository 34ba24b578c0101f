// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "arrow_forest.hpp"
#include "ph/core/barcode.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// A cell in the star of a voxel, with its value in the order of the stars.
struct NumberedCell {
  double value;
  std::uint32_t voxel;
  std::uint32_t number;  ///< of the direction
};

/// Persistent components of one of the two graphs of a grid: the trees that its arrows make, joined
/// by critical cells in the order of the filtration, or backwards (Kruskal, elder rule).
template <class Graph>
class ComponentPairing {
 public:
  ComponentPairing(const StarGrid& grid, const Graph& graph, const RunContext& context)
      : grid_(grid),
        graph_(graph),
        context_(context),
        ticker_(context, "basins"),
        forest_(graph, &context.memory),
        roots_(&context.memory) {
    for (const int part : {0, 1}) add_root(graph.outside(part), endless());
    if (graph.has_endless()) add_endless();
    endless_ = static_cast<std::uint32_t>(roots_.size());
    const auto add = [&](std::uint32_t node, std::uint32_t v, std::uint32_t number) {
      add_root(node, {grid.value(v), v, number});
    };
    constexpr std::uint32_t many = 16;  // of so many voxels one has a critical cell
    if (grid.critical().size() > grid.size() / many) {
      // Most arrows will be met: one after another is quicker.
      graph.for_each_node([&](std::uint32_t node, std::uint32_t to) { forest_.link(node, to); },
                          add, ticker_);
      return;
    }
    for (const std::uint32_t v : grid.critical()) {
      ticker_.work();
      graph.for_each_root(v, add);
    }
  }

  /// @param bridges critical cells by (value, place); those that join nothing are left, in order.
  /// @param on_merge called with (bridge, root that dies; null if both have always been there).
  /// @param on_survivor called with each root that never dies.
  template <class OnMerge, class OnSurvivor>
  void run(std::pmr::vector<NumberedCell>& bridges, OnMerge&& on_merge, OnSurvivor&& on_survivor) {
    const std::size_t size = bridges.size();
    const auto place = [size](std::size_t i) { return Graph::kBackwards ? size - 1 - i : i; };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size + 3 * kStride; ++i) {
      ticker_.work();
      // What is read lies anywhere: it is fetched long before, step by step.
      if (i < size) {
        const NumberedCell& bridge = bridges[place(i)];
        ends_[i % kRing] = graph_.ends(bridge.voxel, bridge.number);
        for (const std::uint32_t end : ends_[i % kRing]) forest_.prefetch(end);
      }
      if (i >= kStride && i - kStride < size)
        for (std::uint32_t& end : ends_[(i - kStride) % kRing])
          forest_.prefetch(end = forest_.step(end));
      if (i >= 2 * kStride && i - 2 * kStride < size)
        for (std::uint32_t& end : ends_[(i - 2 * kStride) % kRing]) {
          end = forest_.find(end, ticker_);
          __builtin_prefetch(&roots_[forest_.number_of_root(end)]);
        }
      if (i < 3 * kStride) continue;
      const NumberedCell bridge = bridges[place(i - 3 * kStride)];
      if (!join(ends_[(i - 3 * kStride) % kRing], bridge, on_merge))
        bridges[place(kept++)] = bridge;
    }
    if (Graph::kBackwards)
      bridges.erase(bridges.begin(), bridges.end() - static_cast<std::ptrdiff_t>(kept));
    else
      bridges.resize(kept);
    for (std::size_t i = endless_; i < roots_.size(); ++i) {
      ticker_.work();
      if (roots_[i].number != kDead) on_survivor(roots_[i]);
    }
  }

 private:
  using Ends = std::array<std::uint32_t, 2>;
  static constexpr std::uint32_t kDead = UINT32_MAX;
  static constexpr std::size_t kStride = 8, kRing = 4 * kStride;

  // What has always been there.
  static NumberedCell endless() { return {Graph::kBackwards ? kInfinity : -kInfinity, 0, 0}; }
  void add_root(std::uint32_t node, const NumberedCell& cell) {
    forest_.set_root(node, static_cast<std::uint32_t>(roots_.size()));
    roots_.push_back(cell);
  }
  // Besides the outside; joined as far as it hangs together.
  void add_endless() {
    Ticker ticker(context_, "holes", grid_.size());
    for (std::uint32_t v = 0; v < grid_.size(); ++v) {
      ticker.tick();
      if (grid_.enters(v)) continue;
      std::optional<std::uint32_t> root;
      graph_.for_each_endless(v, [&](std::uint32_t node) {
        if (!forest_.is_known(node)) return;
        const std::uint32_t own = forest_.find(node, ticker);
        if (root && own != *root) forest_.link(own, *root);
        if (!root) root = own;
      });
      graph_.for_each_endless(v, [&](std::uint32_t node) {
        if (forest_.is_known(node)) return;
        if (root)
          forest_.link(node, *root);
        else
          add_root(*(root = node), endless());
      });
    }
  }
  /// @return whether the ends were apart. @param ends or what hangs over them.
  template <class OnMerge>
  bool join(const Ends& ends, const NumberedCell& bridge, OnMerge&& on_merge) {
    std::uint32_t elder = forest_.find(ends[0], ticker_), younger = forest_.find(ends[1], ticker_);
    if (elder == younger) return false;
    std::uint32_t dies = forest_.number_of_root(younger);
    if (const std::uint32_t a = forest_.number_of_root(elder); is_elder(dies, a)) {
      std::swap(elder, younger);
      dies = a;
    }
    forest_.link(younger, elder);
    on_merge(bridge, dies < endless_ ? nullptr : &roots_[dies]);
    roots_[dies].number = kDead;
    return true;
  }
  // Roots are numbered in the order of the grid, behind what has always been there.
  bool is_elder(std::uint32_t a, std::uint32_t b) const {
    if (a < endless_ || b < endless_) return a < b;
    const double x = roots_[a].value, y = roots_[b].value;
    if (x != y) return Graph::kBackwards ? x > y : x < y;
    return Graph::kBackwards ? a > b : a < b;
  }

  const StarGrid& grid_;
  const Graph& graph_;
  const RunContext& context_;
  Ticker ticker_;
  ArrowForest<Graph> forest_;
  std::pmr::vector<NumberedCell> roots_;
  std::array<Ends, kRing> ends_{};
  std::uint32_t endless_ = 0;  // so many of the roots have always been there
};

}  // namespace ph::cubical
