// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "cubical/stars/critical_cells.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::cubical {

/// What the stars of some voxels say of a graph: the nodes of a star are joined with older ones, or
/// with each other, by the bridges of the star, as far as these are in pairs of no length.
struct StarLinks {
  struct Root {
    std::uint32_t voxel, node, number;
  };
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  StarLinks(std::size_t nodes, std::pmr::memory_resource* memory)
      : arrows(nodes, kUnknown, memory), roots(memory), bridges(memory) {}

  RawVector<std::uint32_t> arrows;  ///< by node; of a root itself
  std::pmr::vector<Root> roots;     ///< in the order of the grid
  CriticalCells bridges;            ///< those in no such pair that may join something
};

/// What one thread finds, in the order of the grid.
struct FoundLinks {
  FoundLinks(RawVector<std::uint32_t>& all_arrows, std::pmr::memory_resource* memory)
      : arrows(all_arrows), roots(memory), bridges(memory) {}

  RawVector<std::uint32_t>& arrows;  ///< of all threads: each node is in one star
  std::pmr::vector<StarLinks::Root> roots;
  std::pmr::vector<NumberedCell> bridges;
};

}  // namespace ph::cubical
