// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <tuple>
#include <utility>
#include <vector>

#include "libph/src/cubical/columns/voxel_chain.hpp"
#include "libph/src/cubical/graphs/forest_steps.hpp"
#include "libph/src/cubical/representatives/component_tree.hpp"
#include "ph/detail/core/radix_sort.hpp"

namespace ph::cubical {

/// Completes chains of edges to cycles. It adds edges of the spanning forest of the components,
/// which consists of arrows and of the bridges that join components. The edges outside the forest
/// determine a cycle, and the youngest edge of a cycle is never in the forest.
template <class Graph, Field K>
class ForestClosing {
 public:
  using Element = typename K::Element;

  ForestClosing(ComponentTree<Graph>& tree, const K& field, const RunContext& context)
      : tree_(tree),
        field_(field),
        context_(context),
        up_(tree.basin_count(), Up{kNone, 0}, &context.memory),
        nodes_(&context.memory),
        basins_(&context.memory) {
    hang_up();
  }

  /// Completes a chain to the cycle that has the same edges outside the forest. Each cell of the
  /// chain must occur once.
  void close(VoxelChain<K>& chain) {
    nodes_.clear();
    basins_.clear();
    for (const auto& term : chain) add_boundary(term.cell, term.coefficient());
    for (const auto& at : nodes_) {
      const std::uint32_t basin = tree_.basin_of(at.node);
      basins_.push_back({up_[basin].depth, basin, at.amount});
    }
    cross_bridges(chain);
    follow_arrows(chain);
    combine(chain, field_);
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Up {
    std::uint32_t merge, depth;
  };
  // The boundary of the chain at a node, or the sum of these boundaries over the nodes of a basin.
  struct AtNode {
    std::uint64_t age;  // a larger age means younger
    std::uint32_t owner, node;
    Element amount;
    auto place() const { return std::tuple(age, Graph::kBackwards ? ~owner : owner, node); }
  };
  struct AtBasin {
    std::uint32_t depth, basin;
    Element amount;
    auto place() const { return std::pair(depth, basin); }
  };

  // Turns the bridges into rooted trees. In each set of connected basins, each basin except the
  // root gets the bridge that leads towards the root.
  void hang_up() {
    const auto merges = tree_.merges();
    std::pmr::vector<std::uint32_t> begin(up_.size() + 1, 0, &context_.memory);
    std::pmr::vector<std::uint32_t> around(2 * merges.size(), &context_.memory);
    Ticker ticker(context_, "forest", 2 * merges.size());
    const auto for_each_end = [&](auto&& use) {
      for (std::uint32_t m = 0; m < merges.size(); ++m)
        for (const std::uint32_t node : tree_.ends(merges[m].bridge)) {
          ticker.work();
          use(tree_.basin_of(node), m);
        }
    };
    for_each_end([&](std::uint32_t basin, std::uint32_t) { ++begin[basin]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& b : begin) b = sum += b;
    for_each_end([&](std::uint32_t basin, std::uint32_t m) { around[--begin[basin]] = m; });
    std::pmr::vector<bool> is_met(up_.size(), false, &context_.memory);
    std::pmr::vector<std::uint32_t> queue(&context_.memory);
    for (std::uint32_t first = 0; first < up_.size(); ++first) {
      if (is_met[first]) continue;
      is_met[first] = true;
      queue.assign(1, first);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::uint32_t from = queue[i];
        for (std::uint32_t k = begin[from]; k < begin[from + 1]; ++k) {
          ticker.tick();
          for (const std::uint32_t node : tree_.ends(merges[around[k]].bridge)) {
            const std::uint32_t to = tree_.basin_of(node);
            if (is_met[to]) continue;
            is_met[to] = true;
            up_[to] = {around[k], up_[from].depth + 1};
            queue.push_back(to);
          }
        }
      }
    }
  }

  void add(std::uint32_t node, Element amount) {
    const std::uint32_t owner = owner_of(tree_.graph(), node);
    const std::uint64_t bits = ordered_bits(tree_.grid().value(owner) + 0.0);
    nodes_.push_back({Graph::kBackwards ? ~bits : bits, owner, node, amount});
  }
  void add_boundary(const StarCell& edge, Element coefficient) {
    const auto [lower, upper] = oriented_ends(tree_.graph(), edge);
    add(upper, coefficient);
    add(lower, field_.negate(coefficient));
  }

  // Removes all entries for the node or basin on top of the heap, and adds them up.
  template <class At>
  At take(std::pmr::vector<At>& heap) {
    const auto before = [](const At& a, const At& b) { return a.place() < b.place(); };
    const auto pop = [&] {
      std::pop_heap(heap.begin(), heap.end(), before);
      const At top = heap.back();
      heap.pop_back();
      return top;
    };
    At sum = pop();
    while (!heap.empty() && heap.front().place() == sum.place())
      sum.amount = field_.add(sum.amount, pop().amount);
    return sum;
  }
  template <class At>
  static void sift(std::pmr::vector<At>& heap) {
    std::push_heap(heap.begin(), heap.end(),
                   [](const At& a, const At& b) { return a.place() < b.place(); });
  }
  template <class At>
  static void order(std::pmr::vector<At>& heap) {
    std::make_heap(heap.begin(), heap.end(),
                   [](const At& a, const At& b) { return a.place() < b.place(); });
  }

  // Adds bridges, from the deepest basins upwards, until the boundary sums to zero in each basin.
  void cross_bridges(VoxelChain<K>& chain) {
    order(basins_);
    Ticker ticker(context_, {});
    while (!basins_.empty()) {
      ticker.work();
      const AtBasin at = take(basins_);
      const std::uint32_t merge = up_[at.basin].merge;
      if (field_.is_zero(at.amount) || merge == kNone) continue;
      const StarCell bridge = tree_.bridge_cell(tree_.merges()[merge].bridge);
      const auto [lower, upper] = oriented_ends(tree_.graph(), bridge);
      const std::uint32_t below = tree_.basin_of(lower);
      // True if the path upwards follows the direction of the edge.
      const bool goes_up = below == at.basin;
      const Element coefficient = goes_up ? at.amount : field_.negate(at.amount);
      chain.emplace_back(bridge, coefficient);
      add_boundary(bridge, coefficient);
      const std::uint32_t to = goes_up ? tree_.basin_of(upper) : below;
      basins_.push_back({up_[to].depth, to, at.amount});
      sift(basins_);
    }
  }
  // Adds arrows, from the youngest node to the oldest, until no boundary is left.
  void follow_arrows(VoxelChain<K>& chain) {
    order(nodes_);
    Ticker ticker(context_, {});
    while (!nodes_.empty()) {
      const AtNode at = take(nodes_);
      if (field_.is_zero(at.amount)) continue;
      // Follows the arrows until they leave the star, because the age of nodes inside a star does
      // not follow the order of the arrows.
      std::uint32_t node = at.node;
      while (const auto step = step_from(tree_.grid(), tree_.graph(), node)) {
        ticker.work();
        chain.emplace_back(step->edge, step->from_upper ? field_.negate(at.amount) : at.amount);
        node = step->to;
        if (owner_of(tree_.graph(), node) == at.owner) continue;
        add(node, at.amount);
        sift(nodes_);
        break;
      }
    }
  }

  ComponentTree<Graph>& tree_;
  const K& field_;
  const RunContext& context_;
  std::pmr::vector<Up> up_;  // indexed by basin
  std::pmr::vector<AtNode> nodes_;
  std::pmr::vector<AtBasin> basins_;
};

}  // namespace ph::cubical
