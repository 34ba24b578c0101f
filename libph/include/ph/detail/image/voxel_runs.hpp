// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ph {

/// Calls `use(first, count)` for each run of consecutive numbers in a set of voxels, in ascending
/// order. Most sets of voxels have far fewer runs than voxels.
/// @param voxels each once, in any order. O(n) if they lie close together, otherwise O(n log n);
/// memory: n / 8 to 8 n bytes. @throws std::bad_alloc.
template <class Use>
void for_each_voxel_run(std::span<const std::uint32_t> voxels, Use&& use) {
  if (voxels.empty()) return;
  const auto [low, high] = std::ranges::minmax(voxels);
  std::uint64_t first = low, end = low;  // bounds of the current run
  const auto meet = [&](std::uint64_t voxel) {
    if (voxel != end) {
      use(first, end - first);
      first = voxel;
    }
    end = voxel + 1;
  };
  if (std::uint64_t{high} - low < 64 * std::uint64_t{voxels.size()}) {
    std::vector<bool> is_in(std::size_t{high} - low + 1);
    for (const std::uint32_t voxel : voxels) is_in[voxel - low] = true;
    for (std::size_t i = 0; i < is_in.size(); ++i)
      if (is_in[i]) meet(std::uint64_t{low} + i);
  } else {
    std::vector<std::uint32_t> sorted(voxels.begin(), voxels.end());
    std::ranges::sort(sorted);
    for (const std::uint32_t voxel : sorted) meet(voxel);
  }
  use(first, end - first);
}

}  // namespace ph
