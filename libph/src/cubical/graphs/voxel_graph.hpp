// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// Voxels, and what has always been there: the outside, in two parts where one axis alone has ends,
/// and voxels that never enter if what never enters is no cell. Roots are voxels without an older
/// neighbour, bridges critical edges.
class VoxelGraph {
 public:
  static constexpr bool kBackwards = false;

  explicit VoxelGraph(const StarGrid& grid) : grid_(grid) {}

  std::size_t size() const { return std::size_t{grid_.size()} + 2; }
  std::uint32_t outside(int part) const { return grid_.size() + static_cast<std::uint32_t>(part); }
  Direction root_direction(std::uint32_t) const { return {}; }
  Direction bridge_direction(std::uint32_t number) const { return kEdges[number]; }

  std::uint32_t arrow(std::uint32_t v) const {
    return across(v, grid_.tables(v).arrow(grid_.star(v)));
  }
  /// Calls `use(node, node)` for the arrows from some rows of voxels but those at the border; a
  /// root may point to itself.
  template <class Use>
  void for_each_inner_arrow(std::uint32_t first_row, std::uint32_t end_row, Use&& use) const {
    // By the edges of a star: how far its arrow leads inside the grid.
    std::array<std::uint32_t, 1 << kEdgeCount> offset{};
    for (std::uint32_t edges = 1; edges < offset.size(); ++edges) {
      const int e = star_tables(0).arrow(edges), axis = axis_of_edge(e);
      offset[edges] = kEdges[e][axis] > 0 ? grid_.stride(axis) : 0 - grid_.stride(axis);
    }
    for (std::uint32_t number = first_row; number < end_row; ++number) {
      const StarGrid::VoxelRow row = grid_.row(number);
      if (row.is_at_border) continue;
      const std::uint32_t end = row.first + grid_.extent(2) - 1;
      for (std::uint32_t v = row.first + 1; v < end; ++v)
        if (const std::uint32_t star = grid_.star(v); star != kAbsent)
          use(v, v + offset[StarTables::edges(star)]);
    }
  }
  /// Whether anything but the outside has always been there.
  bool has_outer_nodes() const { return grid_.is_t_construction() && !grid_.all_enter(); }
  /// Calls `use(node)` for what has always been there and hangs together because a voxel never
  /// enters.
  template <class Use>
  void for_each_outer_node(std::uint32_t v, Use&& use) const {
    use(v);
    for (int e = 0; e < kEdgeCount; ++e) {
      const int axis = axis_of_edge(e);
      if (!grid_.has_axis(axis)) continue;
      const std::uint32_t u = or_outside(grid_.step(v, axis, kEdges[e][axis]), e);
      if (u >= grid_.size() || !grid_.enters(u)) use(u);
    }
  }
  /// Calls `use(node, number)` for the roots in the star of a voxel that enters.
  template <class Use>
  void for_each_root(std::uint32_t v, Use&& use) const {
    if (StarTables::edges(grid_.star(v)) == 0) use(v, 0U);
  }
  /// The nodes that a slab shares with the one before it or after it: those of the ghost layer
  /// and of the one beside it. @return the first one, and how many.
  std::array<std::uint32_t, 2> seam(bool after) const {
    const std::uint32_t count = 2 * grid_.layer_size();
    return {after ? grid_.size() - count : 0, count};
  }
  /// The value of a node of a seam, in the order of the stars; nothing if it never counts.
  std::optional<double> seam_value(std::uint32_t v) const {
    if (!grid_.enters(v) && !grid_.is_t_construction()) return std::nullopt;
    return grid_.value(v);
  }
  /// Whether the slab knows where a node of a seam leads.
  bool is_known_here(std::uint32_t v) const { return !grid_.is_ghost(v); }
  /// What an edge of the star of a voxel joins.
  std::array<std::uint32_t, 2> ends(std::uint32_t v, std::uint32_t number) const {
    return {v, across(v, static_cast<int>(number))};
  }

 private:
  // Across an edge of the star of v.
  std::uint32_t across(std::uint32_t v, int edge) const {
    return or_outside(grid_.step_in_star(v, edge), edge);
  }
  std::uint32_t or_outside(std::uint32_t u, int edge) const {
    if (u != StarGrid::kOutside) return u;
    return outside(grid_.open_axes() == 1 && kEdges[edge][axis_of_edge(edge)] > 0 ? 1 : 0);
  }

  const StarGrid& grid_;
};

}  // namespace ph::cubical
