// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/grid/grid_frame.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// The free edges of a grid with three axes. They are the critical edges that kill no component,
/// and therefore give birth to loops. They are numbered in the order of (voxel, edge).
class FreeEdges {
 public:
  FreeEdges(const GridFrame& frame, const RunContext& context)
      : has_some_(frame.size() / kWord + std::size_t{1}, 0, &context.memory),
        voxels_before_(&context.memory),
        at_(&context.memory) {}

  /// Adds the free edges of one voxel, as bits. Must be called with voxels in ascending order.
  void add(std::uint32_t voxel, unsigned edges) {
    if (edges == 0) return;
    has_some_[voxel / kWord] |= std::uint64_t{1} << (voxel % kWord);
    at_.push_back({count_, static_cast<std::uint8_t>(edges)});
    count_ += static_cast<std::uint32_t>(std::popcount(edges));
  }
  /// Must be called once all edges have been added, before the edges are used.
  void finish() {
    voxels_before_.reserve(has_some_.size());
    std::uint32_t voxels = 0;
    for (const std::uint64_t word : has_some_) {
      voxels_before_.push_back(voxels);
      voxels += static_cast<std::uint32_t>(std::popcount(word));
    }
  }

  std::uint32_t count() const { return count_; }
  /// The number of a free edge. Precondition: the edge is free.
  std::uint32_t number(std::uint32_t voxel, int edge) const {
    const auto& [first, edges] = at_[place(voxel)];
    return first + static_cast<std::uint32_t>(std::popcount(edges & ((1U << edge) - 1)));
  }
  /// Prefetches the data that `number` will read.
  void prefetch(std::uint32_t voxel) const { __builtin_prefetch(&at_[place(voxel)]); }
  /// The edges of one voxel, as bits.
  unsigned edges(std::uint32_t voxel) const {
    return has_some_[voxel / kWord] >> (voxel % kWord) & 1 ? at_[place(voxel)].edges : 0;
  }
  /// Calls `use(voxel, edges as bits)` for all voxels with free edges.
  template <class Use>
  void for_each(Use&& use) const {
    auto at = at_.begin();
    for (std::size_t k = 0; k < has_some_.size(); ++k)
      for (std::uint64_t rest = has_some_[k]; rest != 0; rest &= rest - 1, ++at)
        use(static_cast<std::uint32_t>(k * kWord) +
                static_cast<std::uint32_t>(std::countr_zero(rest)),
            unsigned{at->edges});
  }

 private:
  static constexpr std::uint32_t kWord = 64;
  struct AtVoxel {
    std::uint32_t first;  // the number of the voxel's first edge
    std::uint8_t edges;   // the edges, as bits
  };
  std::size_t place(std::uint32_t voxel) const {
    const std::uint64_t before = (std::uint64_t{1} << (voxel % kWord)) - 1;
    return voxels_before_[voxel / kWord] +
           static_cast<std::size_t>(std::popcount(has_some_[voxel / kWord] & before));
  }

  // For each voxel, a bit that is set if the voxel has free edges.
  std::pmr::vector<std::uint64_t> has_some_;
  // For each word of `has_some_`, the number of voxels with free edges before the word.
  std::pmr::vector<std::uint32_t> voxels_before_;
  std::pmr::vector<AtVoxel> at_;  // one entry for each voxel with free edges
  std::uint32_t count_ = 0;
};

}  // namespace ph::cubical
