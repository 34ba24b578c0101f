// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include "cubical/rounds/part_layout.hpp"
#include "cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// The stars of a part of a grid, and those of the layers beside it once their parts have told
/// them. Cells have the names that they have in the whole grid, so that chains may go anywhere.
class PartStars : public StarGrid {
 public:
  /// @param voxels those of the part and its ghosts. @param place where they lie.
  PartStars(const CubicalImage& voxels, const PartLayout& layout, int part, const SlabPlace& place,
            const RunContext& context)
      : StarGrid(voxels, context, place),
        whole_(layout.size()),
        begin_(layout.first_voxel(part)),
        count_(layout.end_voxel(part) - begin_),
        first_(layout.first_with_ghosts(part)) {}

  /// Whether the part has a voxel of the whole grid; as a ghost it has not.
  bool owns(std::uint64_t voxel) const { return voxel - begin_ < count_; }
  /// Where a voxel of the whole grid is in the part. Precondition: owns(voxel).
  std::uint32_t here(std::uint64_t voxel) const {
    return static_cast<std::uint32_t>(voxel - first_);
  }
  std::uint64_t in_whole(std::uint32_t v) const {
    const std::uint64_t voxel = first_ + v;  // modulo 2^64
    if (voxel < whole_) return voxel;
    return is_before(v) ? voxel + whole_ : voxel - whole_;  // a ghost at an end of a ring
  }
  const StarTables& tables(std::uint32_t v) const {
    // The first layer of a ring may be a ghost here.
    if (slab().is_in_ring && is_ghost(v) && in_whole(v) < layer_size())
      return star_tables(wrapped(v) | 1U << layer_axis());
    return StarGrid::tables(v);
  }

  /// The stars of the layer at an end, which is a ghost for the part beside it.
  std::span<const std::uint32_t> end_layer(bool after) const {
    const std::uint32_t n = layer_size();
    return after ? stars().subspan(size() - n - (slab().has_ghost_after() ? n : 0), n)
                 : stars().subspan(slab().has_ghost_before() ? n : 0, n);
  }
  bool has_ghost(bool after) const {
    return after ? slab().has_ghost_after() : slab().has_ghost_before();
  }
  /// Takes in what the part beside says of its end layer.
  /// @return whether the same voxels enter there as here; nothing has changed if not.
  bool set_ghost(bool after, std::span<const std::uint32_t> stars) {
    const std::uint32_t first = after ? size() - layer_size() : 0;
    for (std::uint32_t i = 0; i < layer_size(); ++i)
      if (enters(first + i) != (stars[i] != kAbsent)) return false;
    for (std::uint32_t i = 0; i < layer_size(); ++i) mark(first + i, stars[i]);
    return true;
  }

 private:
  // Of a ghost: whether it is the one before.
  bool is_before(std::uint32_t v) const { return slab().has_ghost_before() && v < layer_size(); }

  std::uint64_t whole_, begin_, count_, first_;
};

}  // namespace ph::cubical
