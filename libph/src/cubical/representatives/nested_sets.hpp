// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/cubical/representatives/component_tree.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// The items that each component of a tree contains at its death. Two of these sets are either
/// nested or disjoint, so all sets can be stored as slices of one array. The slice of a component
/// starts with the component's own items. The sets of the components that merged into it earlier
/// follow.
class NestedSets {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  struct Range {
    std::size_t begin = 0, end = 0;
  };

  /// @param holder_of called with an item, by several threads: returns the component that contains
  /// the item (ComponentTree::holder), or kNone.
  /// @param name called with an item: returns the number that is stored for the item.
  template <class Graph, class HolderOf, class Name>
  NestedSets(const ComponentTree<Graph>& tree, Before before, std::uint32_t items,
             HolderOf&& holder_of, Name&& name, const RunContext& context)
      : component_of_(items, &context.memory),
        ranges_(tree.basin_count(), &context.memory),
        items_(&context.memory) {
    constexpr std::size_t piece = 1 << 14;
    for_each_piece("sets", items, piece, context, [&](std::size_t i, std::size_t end) {
      for (; i < end; ++i) {
        std::uint32_t holder = holder_of(static_cast<std::uint32_t>(i));
        // A component that was always there and never dies belongs to no bar.
        if (holder != kNone && tree.is_outer(holder) && !tree.dies(holder)) holder = kNone;
        component_of_[i] = holder;
      }
    });
    std::pmr::vector<std::uint32_t> own(ranges_.size(), 0, &context.memory);
    Ticker ticker(context, "sets", 2 * std::uint64_t{items});
    for (const std::uint32_t holder : component_of_) {
      ticker.tick();
      if (holder != kNone) ++own[holder];
    }
    arrange(tree, before, own, context);
    std::pmr::vector<std::uint32_t> filled(ranges_.size(), 0, &context.memory);
    for (std::uint32_t i = 0; i < items; ++i) {
      ticker.tick();
      if (const std::uint32_t holder = component_of_[i]; holder != kNone)
        items_[ranges_[holder].begin + filled[holder]++] = name(i);
    }
  }

  std::span<const std::uint32_t> items() const { return items_; }
  /// The slice that holds the set of a component.
  Range range(std::uint32_t basin) const { return ranges_[basin]; }
  std::span<const std::uint32_t> set(std::uint32_t basin) const {
    const auto [begin, end] = ranges_[basin];
    return std::span(items_).subspan(begin, end - begin);
  }
  /// True if a set contains an item. Must not be called after `forget_components`.
  bool contains(std::uint32_t basin, std::uint32_t item) const {
    const std::uint32_t holder = component_of_[item];
    if (holder == kNone) return false;
    // The place of the first item that this component itself contains.
    const std::size_t place = ranges_[holder].begin;
    return place >= ranges_[basin].begin && place < ranges_[basin].end;
  }
  /// Frees the memory of the components.
  void forget_components() {
    RawVector<std::uint32_t>(component_of_.get_allocator()).swap(component_of_);
  }

 private:
  template <class Graph>
  void arrange(const ComponentTree<Graph>& tree, Before before,
               const std::pmr::vector<std::uint32_t>& own, const RunContext& context) {
    const auto merges = tree.merges();
    std::pmr::vector<std::uint32_t> above(ranges_.size(), kNone, &context.memory);
    for (std::size_t i = merges.size(); i-- > 0;) {
      const auto [bridge, dies, into] = merges[i];
      // Components that die at the same value are separate below this value.
      const bool together = before == Before::value && tree.dies(into) &&
                            tree.death_value(into) == tree.death_value(dies);
      above[dies] = together ? above[into] : into;
    }
    std::pmr::vector<std::size_t> total(own.begin(), own.end(), &context.memory);
    for (const auto& merge : merges) total[above[merge.dies]] += total[merge.dies];
    std::size_t next = 0;
    std::pmr::vector<std::size_t> free(ranges_.size(), 0, &context.memory);
    const auto place = [&](std::uint32_t basin, std::size_t begin) {
      ranges_[basin] = {begin, begin + total[basin]};
      free[basin] = begin + own[basin];
      return begin + total[basin];
    };
    for (std::uint32_t b = 0; b < ranges_.size(); ++b)
      if (!tree.dies(b)) next = place(b, next);
    items_.resize(next);
    for (std::size_t i = merges.size(); i-- > 0;) {
      std::size_t& begin = free[above[merges[i].dies]];
      begin = place(merges[i].dies, begin);
    }
  }

  RawVector<std::uint32_t> component_of_;  // indexed by item
  std::pmr::vector<Range> ranges_;         // indexed by basin
  RawVector<std::uint32_t> items_;
};

}  // namespace ph::cubical
