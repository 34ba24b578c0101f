// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>

#include "ph/core/file_pages.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// A grid in slabs of some layers each; the last one may have fewer. The slowest axis must not be
/// periodic: the first and the last layer would be neighbours.
class Slabs {
 public:
  static bool can_cut(const GridFrame& frame) {
    return frame.top_dim() >= 2 && !frame.is_periodic(frame.layer_axis());
  }
  /// Precondition: can_cut(frame), layers > 0.
  Slabs(const GridFrame& frame, std::uint32_t layers, const RunContext& context)
      : frame_(frame),
        layers_(std::min(layers, depth())),
        cube_pairs_(cube_pair_memos(frame, context)),
        context_(context) {}

  const GridFrame& frame() const { return frame_; }
  std::uint32_t count() const { return (depth() - 1) / layers_ + 1; }
  /// The first voxel of the grid of a slab, ghosts included.
  std::uint32_t first_voxel(std::uint32_t slab) const { return begin(slab) * frame_.layer_size(); }
  /// The stars of a slab, with the layers beside it as ghosts.
  StarGrid stars(std::uint32_t slab) const {
    return {frame_.layers(begin(slab), end(slab)),
            context_,
            {slab > 0, slab + 1 < count(), cube_pairs_}};
  }
  /// What was read of the image for a slab may leave the memory.
  void forget(std::uint32_t slab) const {
    const CubicalImage part = frame_.layers(begin(slab), end(slab));
    if (part.is_in_file) forget_file_pages(part.voxels, part.size() * bytes_of(part.type));
  }

 private:
  std::uint32_t depth() const { return frame_.extent(frame_.layer_axis()); }
  std::uint32_t begin(std::uint32_t slab) const {
    return std::max(slab * layers_, std::uint32_t{1}) - 1;
  }
  std::uint32_t end(std::uint32_t slab) const {
    return slab + 1 == count() ? depth() : (slab + 1) * layers_ + 1;
  }

  const GridFrame& frame_;
  std::uint32_t layers_;
  CubePairMemos cube_pairs_;
  const RunContext& context_;
};

}  // namespace ph::cubical
