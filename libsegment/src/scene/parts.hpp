// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "ph/detail/metric/metric.hpp"

namespace ph::segment {

/// Parts that are large enough, numbered in the order of their first voxels.
struct Parts {
  /// The part number of voxels that are in no large part.
  static constexpr std::uint32_t kSmall = UINT32_MAX;

  std::vector<std::uint32_t> of;       ///< for each voxel, the number of its part, or kSmall
  std::vector<std::uint32_t> example;  ///< for each part, its first voxel

  std::size_t count() const { return example.size(); }
};

/// Numbers the parts of at least `min_size` voxels. @param part_of for each voxel, one of the
/// voxels of its part.
inline Parts number_parts(const std::vector<Index>& part_of, Index min_size) {
  std::vector<Index> sizes(part_of.size());
  for (const Index p : part_of) ++sizes[static_cast<std::size_t>(p)];
  std::vector<std::uint32_t> number(part_of.size(), Parts::kSmall);
  Parts parts;
  for (std::uint32_t v = 0; v < part_of.size(); ++v) {
    const auto p = static_cast<std::size_t>(part_of[v]);
    if (sizes[p] >= min_size && number[p] == Parts::kSmall) {
      number[p] = static_cast<std::uint32_t>(parts.count());
      parts.example.push_back(v);
    }
    parts.of.push_back(number[p]);
  }
  return parts;
}

}  // namespace ph::segment
