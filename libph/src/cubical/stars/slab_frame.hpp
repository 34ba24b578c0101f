// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <utility>
#include <vector>

#include "cubical/stars/grid_frame.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// One for each kind of wrapped voxel; none unless there are three axes.
using CubePairMemos = std::shared_ptr<std::pmr::vector<CubePairMemo>>;
/// @param is_in_ring whether the grid is a part of one whose slowest axis is periodic.
CubePairMemos cube_pair_memos(const GridShape& grid, bool is_in_ring, const RunContext& context);

/// Where a slab lies in a grid. Where the grid goes on, the slab has one more layer, a ghost: it is
/// there for the layer beside it and has no cells. In a ring, whose slowest axis is periodic, the
/// ghost before the first slab is the last layer, and the one after the last slab the first.
struct SlabPlace {
  bool is_first = true, is_last = true, is_in_ring = false;
  CubePairMemos cube_pairs = nullptr;  ///< null: of its own

  bool has_ghost_before() const { return !is_first || is_in_ring; }
  bool has_ghost_after() const { return !is_last || is_in_ring; }
};

/// The voxels of a slab.
class SlabFrame : public GridFrame {
 public:
  /// Precondition: can_hold(grid). @param grid with the ghosts; its slowest axis is not periodic if
  /// the slab is no whole grid.
  SlabFrame(const CubicalImage& grid, SlabPlace slab) : GridFrame(grid), slab_(std::move(slab)) {
    if (slab_.is_in_ring) be_part_of_ring(slab_.is_first ? 1 : UINT32_MAX);
  }

  const SlabPlace& slab() const { return slab_; }
  bool is_ghost(std::uint32_t v) const {
    return (slab_.has_ghost_before() && v < layer_size()) ||
           (slab_.has_ghost_after() && v >= size() - layer_size());
  }
  /// Whether u comes before v in the whole grid. Precondition: v is no ghost.
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
