// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "cubical/graphs/basins.hpp"
#include "ph/detail/components/disjoint_sets.hpp"

namespace ph::cubical {

/// What arrows end at in a slab: a component that is still to be joined with others.
struct SlabRoot {
  enum class Kind : std::uint32_t {
    outer,           ///< has always been there; it has no cell
    critical,        ///< a critical cell
    open_to_around,  ///< a node of the seam of a ring from where the arrows go on in the last slab
    open_to_next,    ///< a node of the seam after it from where they go on in the next slab
  };
  double value;       ///< in the order of the stars; not of what has always been there
  NumberedCell cell;  ///< in the whole grid; open: (the place in the seam, 0)
  Kind kind;
};

/// The roots of the nodes that a slab shares with those before it.
struct SlabSeams {
  std::span<const std::uint32_t> before;  ///< with the slab before it
  std::span<const std::uint32_t> around;  ///< of the last slab of a ring: with the first one
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
  SlabBasins(const StarGrid& grid, const Graph& graph, std::uint32_t first,
             std::pmr::vector<SlabRoot>& roots, const std::array<std::uint32_t, 2>& outside,
             const SlabSeams& seams, const RunContext& context)
      : grid_(grid),
        graph_(graph),
        first_(first),
        roots_(roots),
        context_(context),
        forest_(graph, context),
        same_(roots.size(), &context.memory) {
    follow_inner_arrows(grid, graph, forest_, context);
    for (const int part : {0, 1})
      forest_.set_root(graph.outside(part), outside[static_cast<std::size_t>(part)]);
    const SlabPlace& slab = grid.slab();
    take_roots(seams.before, false);
    take_roots(seams.around, true);
    if (graph.has_outer_nodes()) join_outer_nodes();
    add_critical();
    if (slab.is_first && slab.is_in_ring) add_open(false);
    if (!slab.is_last) add_open(true);
    close_open(seams.before, false);
    close_open(seams.around, true);
  }

  /// Which root a node hangs under. Several threads may ask until `unite` may be called.
  std::uint32_t number(std::uint32_t node) { return forest_.number_of_root(forest_.find(node)); }
  /// The number that stands for a root and all that turned out to be the same.
  std::uint32_t same(std::uint32_t number) { return same_.find(number); }
  /// The roots of the nodes shared with what comes before it or after it.
  std::pmr::vector<std::uint32_t> seam(bool after) {
    const auto [begin, count] = graph_.seam(after);
    std::pmr::vector<std::uint32_t> seam(count, kNone, &context_.memory);
    for (std::uint32_t k = 0; k < count; ++k)
      if (graph_.seam_value(begin + k)) seam[k] = same(number(begin + k));
    return seam;
  }

 private:
  std::uint32_t add(const SlabRoot& root) {
    roots_.push_back(root);
    return same_.add();
  }
  // The nodes of the seam after the last slab of a ring are those before the first one.
  static SlabRoot::Kind open_kind(bool after, const SlabPlace& slab) {
    const bool is_around = slab.is_in_ring && (after ? slab.is_last : slab.is_first);
    return is_around ? SlabRoot::Kind::open_to_around : SlabRoot::Kind::open_to_next;
  }
  // Whether the root of a place of a seam is that node itself.
  bool is_open_at(std::uint32_t root, std::uint32_t place, bool after) const {
    // The seam before a slab is the one after the slab before.
    return roots_[root].kind == open_kind(after, grid_.slab()) && roots_[root].cell.voxel == place;
  }
  void take_roots(std::span<const std::uint32_t> seam, bool after) {
    const std::uint32_t begin = seam.empty() ? 0 : graph_.seam(after)[0];
    for (std::uint32_t k = 0; k < seam.size(); ++k)
      if (seam[k] != kNone && !is_open_at(seam[k], k, after)) forest_.set_root(begin + k, seam[k]);
  }
  void close_open(std::span<const std::uint32_t> seam, bool after) {
    const std::uint32_t begin = seam.empty() ? 0 : graph_.seam(after)[0];
    for (std::uint32_t k = 0; k < seam.size(); ++k)
      if (seam[k] != kNone && is_open_at(seam[k], k, after)) unite(seam[k], number(begin + k));
  }
  // What has always been there stands for all else, then a critical cell; of two that have always
  // been there the one that was met first, of two open ones the one that is open still.
  void unite(std::uint32_t a, std::uint32_t b) {
    using Kind = SlabRoot::Kind;
    a = same(a);
    b = same(b);
    if (a == b) return;
    const Kind kind = roots_[a].kind, other = roots_[b].kind;
    const bool a_stays =
        kind != other ? kind < other : (kind == Kind::open_to_next ? a > b : a < b);
    same_.link(a_stays ? b : a, a_stays ? a : b);
  }
  void join_outer_nodes() {
    Ticker ticker(context_, "holes", grid_.size());
    for (std::uint32_t v = 0; v < grid_.size(); ++v) {
      ticker.tick();
      if (grid_.enters(v) || grid_.is_ghost(v)) continue;
      std::optional<std::uint32_t> root;
      graph_.for_each_outer_node(v, [&](std::uint32_t node) {
        if (!forest_.is_known(node)) return;
        if (root) unite(*root, number(node));
        root = number(node);
      });
      graph_.for_each_outer_node(v, [&](std::uint32_t node) {
        if (forest_.is_known(node)) return;
        if (!root) root = add({0, {}, SlabRoot::Kind::outer});
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
  void add_open(bool after) {
    const auto [begin, count] = graph_.seam(after);
    const SlabRoot::Kind kind = open_kind(after, grid_.slab());
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t node = begin + k;
      if (forest_.is_known(node) || graph_.is_known_here(node)) continue;
      if (const auto value = graph_.seam_value(node))
        forest_.set_root(node, add({*value, {k, 0}, kind}));
    }
  }

  const StarGrid& grid_;
  const Graph& graph_;
  const std::uint32_t first_;
  std::pmr::vector<SlabRoot>& roots_;
  const RunContext& context_;
  ArrowForest<Graph> forest_;
  DisjointSets same_;  // of roots
};

}  // namespace ph::cubical
