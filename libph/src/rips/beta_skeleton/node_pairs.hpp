// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/rips/beta_skeleton/point_tree.hpp"

namespace ph::beta_skeleton {

struct NodePair {
  Node a = 0, b = 0;
};

/// A queue of pairs of nodes by ascending distance, in bins. It is a calendar queue (Brown 1988). A
/// bin that becomes too full is divided into narrower bins.
class NodePairQueue {
 public:
  using Pairs = std::pmr::vector<NodePair>;

  /// Makes an empty queue. @param first pairs at a distance up to this may come in any order.
  NodePairQueue(double first, std::pmr::memory_resource* memory) : levels_(memory) {
    levels_.push_back({key_of(first) >> kWidestShift, kWidestShift, Bins(memory)});
  }

  void push(double distance, NodePair pair) {
    const std::uint64_t key = key_of(distance);
    for (std::size_t l = levels_.size(); l-- > 0;) {
      Level& level = levels_[l];
      const std::uint64_t at = std::max(key >> level.shift, level.first) - level.first;
      const auto bin = std::max<std::size_t>(at, level.next == 0 ? 0 : level.next - 1);
      if (l > 0 && bin >= kParts) continue;
      if (bin >= level.bins.size()) level.bins.resize(bin + 1);
      level.bins[bin].push_back(pair);
      return;
    }
  }
  /// Opens the next bin that is not empty. @return true if there is such a bin.
  bool open_next() {
    for (;; levels_.pop_back()) {
      Level& level = levels_.back();
      if (level.next > 0) Pairs(level.bins.get_allocator()).swap(level.bins[level.next - 1]);
      while (level.next < level.bins.size() && level.bins[level.next].empty()) ++level.next;
      if (level.next < level.bins.size()) {
        ++level.next;
        return true;
      }
      if (levels_.size() == 1) return false;
    }
  }
  /// Takes the pairs of the open bin that were added last, at most `most` of them. @return true if
  /// the bin had pairs.
  bool take(std::size_t most, Pairs& taken) {
    Pairs& open = open_bin();
    const std::size_t count = std::min(most, open.size());
    taken.assign(open.end() - static_cast<std::ptrdiff_t>(count), open.end());
    open.resize(open.size() - count);
    return count > 0;
  }
  /// Once the open bin is empty, all pairs at a distance below this bound have been taken.
  double bound() const {
    const Level& level = levels_.back();
    // mutant: beta-swept-to
    return std::bit_cast<double>((level.first + level.next) << level.shift);
  }
  bool can_narrow() const { return levels_.back().shift >= kPartBits && !open_bin().empty(); }
  /// Divides the pairs left in the open bin among narrower bins, the first of which is opened next.
  template <class DistanceOf>
  void narrow(DistanceOf&& distance_of) {
    Level& wide = levels_.back();
    Pairs left(wide.bins.get_allocator());
    left.swap(open_bin());
    levels_.push_back({(wide.first + wide.next - 1) << kPartBits, wide.shift - kPartBits,
                       Bins(kParts, wide.bins.get_allocator())});
    for (const NodePair& pair : left) push(distance_of(pair), pair);
  }

 private:
  // This shift drops 45 of the 52 bits after the binary point, which leaves 128 bins per power of
  // two.
  static constexpr int kWidestShift = 45;
  static constexpr int kPartBits = 5;
  static constexpr std::size_t kParts = 1 << kPartBits;
  using Bins = std::pmr::vector<Pairs>;
  /// Bins, each of which belongs to the distances with the same leading binary digits. The first
  /// bin and the open bin also receive pairs at smaller distances.
  struct Level {
    std::uint64_t first;  // the leading digits of the distances in bin 0
    int shift;
    Bins bins;
    std::size_t next = 0;  // the bin to open next; the bin before it is open
  };

  /// The bits of a distance. As integers, these bits have the same order as the distances.
  static std::uint64_t key_of(double distance) { return std::bit_cast<std::uint64_t>(distance); }
  Pairs& open_bin() { return levels_.back().bins[levels_.back().next - 1]; }
  const Pairs& open_bin() const { return levels_.back().bins[levels_.back().next - 1]; }

  // Each level except the first divides the open bin of the level before it.
  std::pmr::vector<Level> levels_;
};

}  // namespace ph::beta_skeleton
