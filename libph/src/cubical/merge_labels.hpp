// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/disjoint_sets.hpp"
#include "ph/core/radix_sort.hpp"
#include "ph/core/run_context.hpp"

namespace ph::cubical {

/// A root of arrows, born with a critical cell.
struct Root {
  double value;
  std::uint32_t voxel;
  std::uint32_t number;  ///< of the direction
};
/// A critical cell that joins what has two labels.
struct Bridge {
  double value;
  std::uint32_t a, b;  ///< labels
  std::uint32_t voxel;
  std::uint32_t number;  ///< of the direction
};

/// Components by the elder rule, from what arrows leave. Labels 0 … endless - 1 have always been
/// there, then come the roots. Roots and bridges are given in the order of the grid; the filtration
/// orders them by (value, place), or backwards.
///
/// First in rounds, without sorting: if the first bridge that leaves a component leads to an elder
/// one, the component dies there. (Before that bridge nothing else has joined it. Parts of it that
/// join it later themselves have died with the bridge by which they do, and leave by no earlier
/// one.) What is left is sorted and goes through Kruskal's algorithm.
class LabelMerger {
 public:
  /// @param sets of the endless labels and the roots; what has always hung together is united.
  LabelMerger(DisjointSets&& sets, std::uint32_t endless, const std::pmr::vector<Root>& roots,
              std::pmr::vector<Bridge>& bridges, bool backwards, const RunContext& context)
      : sets_(std::move(sets)),
        endless_(endless),
        roots_(roots),
        bridges_(bridges),
        backwards_(backwards),
        context_(context) {}

  /// @param on_merge called with (bridge, root that dies, or null if both have always been there).
  /// @param on_loop called with each bridge that joins nothing.
  /// @param on_survivor called with each root that never dies.
  template <class OnMerge, class OnLoop, class OnSurvivor>
  void run(OnMerge&& on_merge, OnLoop&& on_loop, OnSurvivor&& on_survivor) {
    drop_loops(on_loop);
    for (std::size_t before = 2 * bridges_.size(); bridges_.size() < before - before / 4;) {
      before = bridges_.size();
      merge_round(on_merge);
      drop_loops(on_loop);
    }
    radix_sort_by_value(
        bridges_, [](const Bridge& b) { return b.value; }, context_);
    Ticker ticker(context_, "components", bridges_.size());
    for (std::size_t i = 0; i < bridges_.size(); ++i) {
      ticker.tick();
      const Bridge& bridge = bridges_[backwards_ ? bridges_.size() - 1 - i : i];
      std::uint32_t elder = sets_.find(bridge.a), younger = sets_.find(bridge.b);
      if (elder == younger) {
        on_loop(bridge);
        continue;
      }
      if (is_elder(younger, elder)) std::swap(elder, younger);
      sets_.link(younger, elder);
      on_merge(bridge, younger < endless_ ? nullptr : &roots_[younger - endless_]);
    }
    for (std::uint32_t i = 0; i < roots_.size(); ++i) {
      ticker.work();
      if (sets_.find(endless_ + i) == endless_ + i) on_survivor(roots_[i]);
    }
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  bool is_elder(std::uint32_t a, std::uint32_t b) const {
    if (a < endless_ || b < endless_) return a < b;
    const double x = roots_[a - endless_].value, y = roots_[b - endless_].value;
    if (x != y) return backwards_ ? x > y : x < y;
    return backwards_ ? a > b : a < b;
  }
  bool comes_before(std::uint32_t i, std::uint32_t j) const {
    const double x = bridges_[i].value, y = bridges_[j].value;
    if (x != y) return backwards_ ? x > y : x < y;
    return backwards_ ? i > j : i < j;
  }
  template <class OnMerge>
  void merge_round(OnMerge&& on_merge) {
    Ticker ticker(context_, "basins", bridges_.size());
    std::pmr::vector<std::uint32_t> first(roots_.size(), kNone, &context_.memory);
    for (std::uint32_t i = 0; i < bridges_.size(); ++i) {
      ticker.tick();
      for (const std::uint32_t label : {bridges_[i].a, bridges_[i].b}) {
        if (label < endless_) continue;
        std::uint32_t& best = first[label - endless_];
        if (best == kNone || comes_before(i, best)) best = i;
      }
    }
    for (std::uint32_t r = 0; r < roots_.size(); ++r) {
      ticker.work();
      if (first[r] == kNone) continue;
      Bridge& bridge = bridges_[first[r]];
      const std::uint32_t label = endless_ + r;
      const std::uint32_t other = bridge.a == label ? bridge.b : bridge.a;
      if (!is_elder(other, label)) continue;
      sets_.link(label, other);
      on_merge(bridge, &roots_[r]);
      bridge.number = kNone;  // done; it leads from its root to an elder one, so to no third one
    }
  }
  template <class OnLoop>
  void drop_loops(OnLoop&& on_loop) {
    Ticker ticker(context_, "basins", bridges_.size());
    std::size_t kept = 0;
    for (Bridge bridge : bridges_) {
      ticker.tick();
      bridge.a = sets_.find(bridge.a);
      bridge.b = sets_.find(bridge.b);
      if (bridge.number == kNone) continue;
      if (bridge.a == bridge.b)
        on_loop(bridge);
      else
        bridges_[kept++] = bridge;
    }
    bridges_.resize(kept);
  }

  DisjointSets sets_;
  std::uint32_t endless_;
  const std::pmr::vector<Root>& roots_;
  std::pmr::vector<Bridge>& bridges_;
  bool backwards_;
  const RunContext& context_;
};

}  // namespace ph::cubical
