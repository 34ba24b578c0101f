// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/stars/critical_cells.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// The findings of the stars of some voxels about a graph: the bridges of a star join its nodes
/// with older nodes, or with each other, as far as they are in pairs of length zero.
struct StarLinks {
  struct Root {
    std::uint32_t voxel, node, number;
  };
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  StarLinks(std::size_t nodes, std::pmr::memory_resource* memory)
      : arrows(nodes, kUnknown, memory), roots(memory), bridges(memory) {}

  RawVector<std::uint32_t> arrows;  ///< by node; a root points to itself
  std::pmr::vector<Root> roots;     ///< in the order of the grid
  CriticalCells bridges;            ///< bridges in no such pair that may join components
};

/// The findings of one thread, in the order of the grid.
struct FoundLinks {
  FoundLinks(RawVector<std::uint32_t>& all_arrows, std::pmr::memory_resource* memory)
      : arrows(all_arrows), roots(memory), bridges(memory) {}

  RawVector<std::uint32_t>& arrows;  ///< shared by all threads, because each node is in one star
  std::pmr::vector<StarLinks::Root> roots;
  std::pmr::vector<NumberedCell> bridges;
};

}  // namespace ph::cubical
