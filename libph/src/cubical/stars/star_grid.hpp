// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "cubical/stars/grid_frame.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// One for each kind of wrapped voxel; none unless there are three axes.
using CubePairMemos = std::shared_ptr<std::pmr::vector<CubePairMemo>>;
/// @param is_in_ring whether the frame is a part of a grid whose slowest axis is periodic.
CubePairMemos cube_pair_memos(const GridFrame& frame, bool is_in_ring, const RunContext& context);

/// Where a slab lies in a grid. Where the grid goes on, the slab has one more layer, a ghost: it is
/// there for the layer beside it and has no cells. In a ring, whose slowest axis is periodic, the
/// ghost before the first slab is the last layer, and the one after the last slab the first.
struct SlabPlace {
  bool is_first = true, is_last = true, is_in_ring = false;
  CubePairMemos cube_pairs = nullptr;  ///< null: of its own

  bool has_ghost_before() const { return !is_first || is_in_ring; }
  bool has_ghost_after() const { return !is_last || is_in_ring; }
};

/// The lower stars of a grid, or of some of its layers.
class StarGrid : public GridFrame {
 public:
  /// Precondition: can_hold(grid).
  StarGrid(const CubicalImage& grid, const RunContext& context, const SlabPlace& slab = {});

  std::uint32_t star(std::uint32_t v) const { return stars_[v]; }
  std::span<const std::uint32_t> stars() const { return stars_; }
  /// Asks for a star some time before it is looked at.
  void expect_star(std::uint32_t v) const { __builtin_prefetch(&stars_[v]); }
  /// As StoredStars has it: all are in memory anyway.
  static void tidy() {}
  bool enters(std::uint32_t v) const { return stars_[v] != kAbsent; }
  bool is_ghost(std::uint32_t v) const {
    return (slab_.has_ghost_before() && v < layer_size()) ||
           (slab_.has_ghost_after() && v >= size() - layer_size());
  }
  const SlabPlace& slab() const { return slab_; }
  /// Marks edges of a star: they kill a component. Of three axes only.
  void mark(std::uint32_t v, std::uint32_t bits) { stars_[v] |= bits; }
  bool all_enter() const { return all_enter_; }
  /// The voxels with a critical cell in their stars, ascending.
  std::span<const std::uint32_t> critical() const { return critical_; }
  /// Of three axes only.
  CubePairs pair_cubes(std::uint32_t v) const {
    return (*cube_pairs_)[any_periodic_ ? wrapped(v) : 0].pair_cubes(stars_[v]);
  }

 private:
  /// A part of a row.
  struct Block {
    std::uint32_t z, y, begin, end;
  };
  template <class Ages, class T>
  void find_stars(const T* voxels);
  template <class Ages, class T>
  void find_block(const T* voxels, const Block& block, std::uint32_t* stars) const;
  template <class Ages, class T>
  std::uint32_t find_one(const T* voxels, std::uint32_t v) const;
  /// Whether u comes before v in the whole grid. Precondition: v is no ghost.
  bool comes_before(std::uint32_t u, std::uint32_t v) const {
    const bool is_from_other_end =
        slab_.is_in_ring &&
        ((slab_.is_first && u < layer_size()) || (slab_.is_last && u >= size() - layer_size()));
    return (u < v) != is_from_other_end;
  }

  const RunContext& context_;
  SlabPlace slab_;
  bool all_enter_ = true;
  RawVector<std::uint32_t> stars_;
  CubePairMemos cube_pairs_;
  std::pmr::vector<std::uint32_t> critical_;
};

}  // namespace ph::cubical
