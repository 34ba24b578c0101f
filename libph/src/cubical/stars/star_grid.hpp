// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/cubical/grid/slab_frame.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// The lower stars of a grid, or of some of its layers.
class StarGrid : public SlabFrame {
 public:
  /// True if at most three axes of the image are kept and a GridFrame can hold the image.
  static bool can_hold(const CubicalImage& grid) {
    return GridShape::count_axes(grid) <= 3 && GridFrame::can_hold(grid);
  }
  /// Precondition: can_hold(grid).
  StarGrid(const CubicalImage& grid, const RunContext& context, const SlabPlace& slab = {});

  std::uint32_t star(std::uint32_t v) const { return stars_[v]; }
  std::span<const std::uint32_t> stars() const { return stars_; }
  /// Prefetches a star some time before it is read.
  void expect_star(std::uint32_t v) const { __builtin_prefetch(&stars_[v]); }
  /// Does nothing, because all stars are in memory. See StoredStars::tidy.
  static void tidy() {}
  bool enters(std::uint32_t v) const { return stars_[v] != kAbsent; }
  /// Marks the edges of a star that kill a component. Only for three axes. @param bits the marks of
  /// these edges.
  void mark(std::uint32_t v, std::uint32_t bits) { stars_[v] |= bits; }
  bool all_enter() const { return all_enter_; }
  /// The voxels whose stars have a critical cell, in ascending order.
  std::span<const std::uint32_t> critical() const { return critical_; }
  /// The pairs of the cubes in the star of a voxel. Only for three axes.
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
  std::size_t close_stars(std::uint32_t begin, std::uint32_t end, std::uint32_t* list);
  template <class Ages, class T>
  void find_block(const T* voxels, const Block& block, std::uint32_t* stars) const;
  template <class Ages, class T>
  std::uint32_t find_one(const T* voxels, std::uint32_t v) const;

  const RunContext& context_;
  bool all_enter_ = true;
  RawVector<std::uint32_t> stars_;
  CubePairMemos cube_pairs_;
  std::pmr::vector<std::uint32_t> critical_;
};

}  // namespace ph::cubical
