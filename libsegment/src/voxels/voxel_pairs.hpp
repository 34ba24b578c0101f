// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::segment {

/// Two voxels near each other.
struct VoxelPair {
  std::uint32_t u, v;  ///< u < v
  float distance;      ///< the distance of their centroids, in metres
};

using VoxelPairs = RawVector<VoxelPair>;

/// All pairs of voxels whose centroids are closer than `reach` voxels, in an order that depends
/// only on the voxels. Takes O(rows * reach^2 + pairs) time, and needs no tree or hash.
/// @param voxel the edge of a voxel of the grid, in metres. @param reach the number of voxels, > 0.
/// It must be small, because the search visits all offsets within it. @throws Error (usage) like
/// require_exact_cells; Error (resource, cancelled).
VoxelPairs close_voxels(const VoxelGrid& grid, double voxel, double reach,
                        const RunContext& context = default_context());

/// Calls `use` for the pairs with a distance below `radius`, in their order. The function selects
/// the pairs in batches, because their distances are unpredictable. A branch for each pair would be
/// mispredicted every third time.
template <class Use>
void for_each_within(std::span<const VoxelPair> pairs, double radius, Use&& use) {
  constexpr std::size_t some = 256;
  std::array<VoxelPair, some> near;
  for (; !pairs.empty(); pairs = pairs.subspan(std::min(some, pairs.size()))) {
    std::size_t count = 0;
    for (const VoxelPair& p : pairs.first(std::min(some, pairs.size()))) {
      near[count] = p;
      count += p.distance < radius ? 1 : 0;
    }
    for (const VoxelPair& p : std::span(near).first(count)) use(p);
  }
}

}  // namespace ph::segment
