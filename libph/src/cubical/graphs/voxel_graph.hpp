// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "libph/src/cubical/graphs/voxel_nodes.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// The graph of voxels in the stars of up to three axes. Its roots are voxels without an older
/// neighbour, and its bridges are critical edges.
class VoxelGraph : public VoxelNodes<StarGrid> {
 public:
  using VoxelNodes::VoxelNodes;

  Direction root_direction(std::uint32_t) const { return {}; }
  Direction bridge_direction(std::uint32_t number) const { return kEdges[number]; }

  std::uint32_t arrow(std::uint32_t v) const {
    return across(v, grid_.tables(v).arrow(grid_.star(v)));
  }
  /// Calls `use(node, end of its arrow)` for the voxels of a range of rows, except at the border. A
  /// root may point to itself.
  template <class Use>
  void for_each_inner_arrow(std::uint32_t first_row, std::uint32_t end_row, Use&& use) const {
    // For each set of edges of a star, the offset from the voxel to the end of its arrow if the
    // star has these edges.
    std::array<std::uint32_t, 1 << kEdgeCount> offset{};
    for (std::uint32_t edges = 1; edges < offset.size(); ++edges) {
      const int e = star_tables(0).arrow(edges), axis = axis_of_edge(e);
      offset[edges] = kEdges[e][axis] > 0 ? grid_.stride(axis) : 0 - grid_.stride(axis);
    }
    for (std::uint32_t number = first_row; number < end_row; ++number) {
      const StarGrid::VoxelRow row = grid_.row(number);
      if (row.is_at_border) continue;
      const std::uint32_t end = row.first + grid_.extent(2) - 1;
      // With one axis, a slab of a ring may have a ghost before the first voxel of the ring.
      const std::uint32_t begin = row.first + (grid_.is_wrapped(2, 1) ? 2 : 1);
      for (std::uint32_t v = begin; v < end; ++v)
        if (const std::uint32_t star = grid_.star(v); star != kAbsent)
          use(v, v + offset[StarTables::edges(star)]);
    }
  }
  /// Calls `use(node, number in the star)` for the root in the star of a voxel that enters, if
  /// there is one.
  template <class Use>
  void for_each_root(std::uint32_t v, Use&& use) const {
    if (StarTables::edges(grid_.star(v)) == 0) use(v, 0U);
  }
  /// The two nodes that an edge in a voxel's star joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t v, std::uint32_t number) const {
    return {v, across(v, static_cast<int>(number))};
  }

 private:
  // The node at the other end of an edge in the star of v.
  std::uint32_t across(std::uint32_t v, int edge) const {
    return or_outside(grid_.step_in_star(v, edge), kEdges[edge][axis_of_edge(edge)]);
  }
};

}  // namespace ph::cubical
