// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/stars/critical_cells.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// Arrows, roots and bridges of a graph, as found in the stars of some voxels. The arrow of a node
/// crosses a bridge of the same star, and this bridge is in a pair of length zero. The arrow leads
/// to an older node or to another node of the star.
struct StarLinks {
  struct Root {
    std::uint32_t voxel, node, number;
  };
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  StarLinks(std::size_t nodes, std::pmr::memory_resource* memory)
      : arrows(nodes, kUnknown, memory), roots(memory), bridges(memory) {}

  RawVector<std::uint32_t> arrows;  ///< indexed by node; a root points to itself
  std::pmr::vector<Root> roots;     ///< in the order of the grid
  /// Bridges that are in no pair of length zero and may join components.
  CriticalCells bridges;
};

/// The arrows, roots and bridges that one thread has found, in the order of the grid.
struct FoundLinks {
  FoundLinks(RawVector<std::uint32_t>& all_arrows, std::pmr::memory_resource* memory)
      : arrows(all_arrows), roots(memory), bridges(memory) {}

  /// The array is shared by all threads. Only one thread sets each entry, because each node is in
  /// one star.
  RawVector<std::uint32_t>& arrows;
  std::pmr::vector<StarLinks::Root> roots;
  std::pmr::vector<NumberedCell> bridges;
};

}  // namespace ph::cubical
