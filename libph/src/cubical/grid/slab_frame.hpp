// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <utility>
#include <vector>

#include "libph/src/cubical/grid/grid_frame.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// One CubePairMemo for each value of `wrapped` (StarTables) that occurs. The vector is empty
/// unless there are three axes.
using CubePairMemos = std::shared_ptr<std::pmr::vector<CubePairMemo>>;
/// @param is_in_ring true if the grid is a part of a larger grid whose slowest axis is periodic.
CubePairMemos cube_pair_memos(const GridShape& grid, bool is_in_ring, const RunContext& context);

/// The position of a slab in a grid. Where the grid continues, the slab has one more layer, a
/// *ghost*. The ghost is needed to compute the layer beside it, and has no cells of its own. In a
/// ring, whose slowest axis is periodic, the ghost before the first slab is the last layer, and the
/// ghost after the last slab is the first layer.
struct SlabPlace {
  bool is_first = true, is_last = true, is_in_ring = false;
  CubePairMemos cube_pairs = nullptr;  ///< memos that slabs share; null if the slab has its own

  bool has_ghost_before() const { return !is_first || is_in_ring; }
  bool has_ghost_after() const { return !is_last || is_in_ring; }
};

/// The voxels of a slab.
class SlabFrame : public GridFrame {
 public:
  /// Precondition: can_hold(grid). @param grid the voxels of the slab and of its ghosts. The
  /// slowest axis of `grid` is not periodic unless the slab is the entire grid.
  SlabFrame(const CubicalImage& grid, SlabPlace slab) : GridFrame(grid), slab_(std::move(slab)) {
    if (slab_.is_in_ring) be_part_of_ring(slab_.is_first ? 1 : UINT32_MAX);
  }

  const SlabPlace& slab() const { return slab_; }
  bool is_ghost(std::uint32_t v) const {
    return (slab_.has_ghost_before() && v < layer_size()) ||
           (slab_.has_ghost_after() && v >= size() - layer_size());
  }
  /// True if u comes before v in the entire grid. Precondition: v is not a ghost.
  bool comes_before(std::uint32_t u, std::uint32_t v) const {
    const bool is_from_other_end =
        slab_.is_in_ring &&
        ((slab_.is_first && u < layer_size()) || (slab_.is_last && u >= size() - layer_size()));
    return (u < v) != is_from_other_end;
  }

 private:
  SlabPlace slab_;
};

}  // namespace ph::cubical
