// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "libph/src/cubical/rounds/part_layout.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// The stars of a part of a grid, and the stars of its ghosts once the other parts have sent them.
/// Cells have the same names as in the entire grid, so chains can be sent to any part.
class PartStars : public StarGrid {
 public:
  /// @param voxels the voxels of the part and its ghosts.
  PartStars(const CubicalImage& voxels, const PartLayout& layout, int part,
            const RunContext& context)
      : StarGrid(voxels, context, layout.place(part)),
        whole_(layout.size()),
        first_(layout.first_voxel(part)),
        begin_(layout.own(part).begin * layer_size()),
        count_(layout.own(part).count() * layer_size()) {}

  /// True if a voxel of the entire grid belongs to the part itself.
  bool owns(std::uint64_t voxel) const { return voxel - begin_ < count_; }
  /// True if the part sees a voxel at its usual place. The part sees its own voxels and its ghosts,
  /// except for ghosts from the other end of a ring.
  bool sees(std::uint64_t voxel) const { return voxel - first_ < size(); }
  /// The local number of a voxel. Precondition: sees(voxel).
  std::uint32_t here(std::uint64_t voxel) const {
    return static_cast<std::uint32_t>(voxel - first_);
  }
  /// True if the part sees all voxels of a square in the star of v. Precondition: the part sees v.
  /// If v is a ghost, the square may reach layers that the part does not see.
  bool sees_square(std::uint32_t v, int square) const {
    if (!is_ghost(v)) return true;
    const int away = kSquares[square][layer_axis()];
    return is_before(v) ? away >= 0 : away <= 0;  // mutant: ghost-squares
  }
  std::uint64_t in_whole(std::uint32_t v) const {
    const std::uint64_t voxel = first_ + v;  // modulo 2^64
    if (voxel < whole_) return voxel;
    // The voxel is a ghost at an end of a ring.
    return is_before(v) ? voxel + whole_ : voxel - whole_;
  }
  const StarTables& tables(std::uint32_t v) const {
    // This ghost may be the first layer of a ring.
    if (slab().is_in_ring && is_ghost(v) && in_whole(v) < layer_size())  // mutant: ghost-of-ring
      return star_tables(wrapped(v) | 1U << layer_axis());
    return StarGrid::tables(v);
  }

  /// The stars of one of the part's own layers.
  std::span<const std::uint32_t> layer(std::uint64_t of_whole) const {
    return stars().subspan(here(of_whole * layer_size()), layer_size());
  }
  /// Marks the critical edges in the part's own stars that are not free.
  void mark_own(const FreeEdges& free) {
    mark_all_but(*this, free, here(begin_), here(begin_ + count_));
  }
  /// Stores the stars of a layer that another part owns, in each place where the layer is a ghost
  /// of this part.
  /// @return the number of ghost layers filled, or nothing if the two parts disagree about the
  /// voxels that enter.
  std::optional<std::size_t> hear(std::uint64_t of_whole, std::span<const std::uint32_t> stars) {
    std::size_t count = 0;
    for (const std::uint32_t first : {0U, size() - layer_size()}) {
      if (!is_ghost(first) || in_whole(first) != of_whole * layer_size()) continue;
      for (std::uint32_t i = 0; i < layer_size(); ++i)
        if (enters(first + i) != (stars[i] != kAbsent)) return std::nullopt;
      for (std::uint32_t i = 0; i < layer_size(); ++i) mark(first + i, stars[i]);
      ++count;
    }
    return count;
  }

 private:
  // For a voxel of a ghost layer, true if that layer is before the part.
  bool is_before(std::uint32_t v) const { return slab().has_ghost_before() && v < layer_size(); }

  std::uint64_t whole_, first_, begin_, count_;
};

}  // namespace ph::cubical
