// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "grid_frame.hpp"
#include "ph/core/run_context.hpp"

namespace ph::cubical {

/// The critical edges of three axes that kill no component: what gives birth to loops. They have
/// numbers, in the order of (voxel, edge).
class FreeEdges {
 public:
  FreeEdges(const GridFrame& frame, const RunContext& context)
      : row_length_(Divisor(frame.extent(2))),
        voxels_(&context.memory),
        edges_(&context.memory),
        first_(&context.memory),
        row_(&context.memory) {
    row_.reserve(frame.row_count() + std::size_t{1});
  }

  /// Those of one voxel, as bits. Voxels come in ascending order.
  void add(std::uint32_t voxel, unsigned edges) {
    if (edges == 0) return;
    begin_rows(row_length_.divide(voxel));
    voxels_.push_back(voxel);
    edges_.push_back(static_cast<std::uint8_t>(edges));
    first_.push_back(count_);
    count_ += static_cast<std::uint32_t>(std::popcount(edges));
  }
  /// When all have come.
  void finish() { begin_rows(row_.capacity() - 1); }

  std::uint32_t count() const { return count_; }
  std::uint32_t number(std::uint32_t voxel, int edge) const {
    const std::size_t i = *place_of(voxel);
    return first_[i] + static_cast<std::uint32_t>(std::popcount(edges_[i] & ((1U << edge) - 1)));
  }
  /// Those of one voxel, as bits.
  unsigned edges(std::uint32_t voxel) const {
    const auto i = place_of(voxel);
    return i ? edges_[*i] : 0;
  }
  /// Calls `use(voxel, edges)` for all voxels that have some.
  template <class Use>
  void for_each(Use&& use) const {
    for (std::size_t i = 0; i < voxels_.size(); ++i) use(voxels_[i], unsigned{edges_[i]});
  }

 private:
  std::optional<std::size_t> place_of(std::uint32_t voxel) const {
    const std::uint32_t row = row_length_.divide(voxel);
    const auto end = voxels_.begin() + row_[row + 1];
    const auto at = std::lower_bound(voxels_.begin() + row_[row], end, voxel);
    if (at == end || *at != voxel) return std::nullopt;
    return static_cast<std::size_t>(at - voxels_.begin());
  }
  void begin_rows(std::size_t last) {
    while (row_.size() <= last) row_.push_back(static_cast<std::uint32_t>(voxels_.size()));
  }

  Divisor row_length_;
  std::pmr::vector<std::uint32_t> voxels_;
  std::pmr::vector<std::uint8_t> edges_;   // by voxel
  std::pmr::vector<std::uint32_t> first_;  // by voxel: the number of the first one
  std::pmr::vector<std::uint32_t> row_;    // by row: the first voxel
  std::uint32_t count_ = 0;
};

}  // namespace ph::cubical
