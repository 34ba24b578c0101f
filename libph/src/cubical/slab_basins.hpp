// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "basins.hpp"

namespace ph::cubical {

/// What arrows end at in a slab: a component that is still to be joined with others.
struct SlabRoot {
  enum class Kind : std::uint32_t {
    endless,   ///< has always been there; it has no cell
    critical,  ///< a critical cell
    open,      ///< a node of the seam from where the arrows go on in the next slab
  };
  double value;       ///< in the order of the stars; not of what has always been there
  NumberedCell cell;  ///< in the whole grid; open: (the place in the seam, 0)
  Kind kind;

  bool is_open_at(std::uint32_t place) const { return kind == Kind::open && cell.voxel == place; }
};

/// The trees that the arrows make in one slab of a grid, from the roots that were met before and
/// those that come with it. Roots have numbers: first those from before, then what has always been
/// there, critical cells in the order of the grid, and what is open.
template <class Graph>
class SlabBasins {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// @param first the slab's first voxel in the whole grid.
  /// @param roots those from before; new ones are appended. @param outside which of them are its
  ///        parts.
  /// @param seam the roots of the nodes shared with the slab before.
  SlabBasins(const StarGrid& grid, const Graph& graph, std::uint32_t first,
             std::pmr::vector<SlabRoot>& roots, const std::array<std::uint32_t, 2>& outside,
             std::span<const std::uint32_t> seam, const RunContext& context)
      : grid_(grid),
        graph_(graph),
        first_(first),
        roots_(roots),
        context_(context),
        forest_(graph, context),
        same_(roots.size(), &context.memory) {
    std::iota(same_.begin(), same_.end(), 0U);
    follow_inner_arrows(grid, graph, forest_, context);
    for (const int part : {0, 1})
      forest_.set_root(graph.outside(part), outside[static_cast<std::size_t>(part)]);
    const std::uint32_t before = seam.empty() ? 0 : graph.seam(false)[0];
    for (std::uint32_t k = 0; k < seam.size(); ++k)
      if (seam[k] != kNone && !roots_[seam[k]].is_open_at(k)) forest_.set_root(before + k, seam[k]);
    if (graph.has_endless()) join_endless();
    add_critical();
    if (grid.has_ghost_after()) add_open();
    for (std::uint32_t k = 0; k < seam.size(); ++k)
      if (seam[k] != kNone && roots_[seam[k]].is_open_at(k)) unite(seam[k], number(before + k));
  }

  /// Which root a node hangs under. Several threads may ask until `unite` may be called.
  std::uint32_t number(std::uint32_t node) { return forest_.number_of_root(forest_.find(node)); }
  /// The number that stands for a root and all that turned out to be the same.
  std::uint32_t same(std::uint32_t number) {
    while (same_[number] != number) number = same_[number] = same_[same_[number]];
    return number;
  }
  /// The roots of the nodes shared with the slab after it.
  std::pmr::vector<std::uint32_t> seam_after() {
    const auto [begin, count] = graph_.seam(true);
    std::pmr::vector<std::uint32_t> seam(count, kNone, &context_.memory);
    for (std::uint32_t k = 0; k < count; ++k)
      if (graph_.seam_value(begin + k)) seam[k] = same(number(begin + k));
    return seam;
  }

 private:
  std::uint32_t add(const SlabRoot& root) {
    roots_.push_back(root);
    same_.push_back(static_cast<std::uint32_t>(same_.size()));
    return same_.back();
  }
  // What has always been there stands for all else, then a critical cell; of two that have always
  // been there the one that was met first, of two open ones the one that is open still.
  void unite(std::uint32_t a, std::uint32_t b) {
    using Kind = SlabRoot::Kind;
    a = same(a);
    b = same(b);
    if (a == b) return;
    const Kind kind = roots_[a].kind, other = roots_[b].kind;
    const bool a_stays = kind != other ? kind < other : (kind == Kind::open ? a > b : a < b);
    same_[a_stays ? b : a] = a_stays ? a : b;
  }
  void join_endless() {
    Ticker ticker(context_, "holes", grid_.size());
    for (std::uint32_t v = 0; v < grid_.size(); ++v) {
      ticker.tick();
      if (grid_.enters(v) || grid_.is_ghost(v)) continue;
      std::optional<std::uint32_t> root;
      graph_.for_each_endless(v, [&](std::uint32_t node) {
        if (!forest_.is_known(node)) return;
        if (root) unite(*root, number(node));
        root = number(node);
      });
      graph_.for_each_endless(v, [&](std::uint32_t node) {
        if (forest_.is_known(node)) return;
        if (!root) root = add({0, {}, SlabRoot::Kind::endless});
        forest_.set_root(node, *root);
      });
    }
  }
  void add_critical() {
    Ticker ticker(context_, {});
    for (const std::uint32_t v : grid_.critical()) {
      ticker.work();
      graph_.for_each_root(v, [&](std::uint32_t node, std::uint32_t number) {
        forest_.set_root(node,
                         add({grid_.value(v), {v + first_, number}, SlabRoot::Kind::critical}));
      });
    }
  }
  void add_open() {
    const auto [begin, count] = graph_.seam(true);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t node = begin + k;
      if (forest_.is_known(node) || graph_.is_known_here(node)) continue;
      if (const auto value = graph_.seam_value(node))
        forest_.set_root(node, add({*value, {k, 0}, SlabRoot::Kind::open}));
    }
  }

  const StarGrid& grid_;
  const Graph& graph_;
  const std::uint32_t first_;
  std::pmr::vector<SlabRoot>& roots_;
  const RunContext& context_;
  ArrowForest<Graph> forest_;
  std::pmr::vector<std::uint32_t> same_;
};

}  // namespace ph::cubical
