// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>

namespace ph::cubical {

/// The nodes of a graph of voxels for any number of axes. They are the voxels and the outside,
/// which has two parts if only one axis has ends. The outside was always there. In the
/// T-construction, voxels that never enter are not cells, and were also always there.
/// @tparam Grid a SlabFrame that knows which voxels enter.
template <class Grid>
class VoxelNodes {
 public:
  static constexpr bool kBackwards = false;

  explicit VoxelNodes(const Grid& grid) : grid_(grid) {}

  std::size_t size() const { return std::size_t{grid_.size()} + 2; }
  std::uint32_t outside(int part) const { return grid_.size() + static_cast<std::uint32_t>(part); }
  /// True if nodes other than the outside were always there.
  bool has_outer_nodes() const { return grid_.is_t_construction() && !grid_.all_enter(); }
  /// A voxel that never enters connects nodes that were always there. Calls `use(node)` for these
  /// nodes.
  template <class Use>
  void for_each_outer_node(std::uint32_t v, Use&& use) const {
    use(v);
    for (int a = 0; a < grid_.axis_count(); ++a)
      for (const int sign : {-1, 1}) {
        if (!grid_.has_axis(a)) continue;
        const std::uint32_t u = or_outside(grid_.step(v, a, sign), sign);
        if (u >= grid_.size() || !grid_.enters(u)) use(u);
      }
  }
  /// The nodes that a slab shares with the preceding or the following slab. They are the nodes of
  /// the ghost layer and of the layer beside it. @return the first node, and the number of nodes.
  std::array<std::uint32_t, 2> seam(bool after) const {
    const std::uint32_t count = 2 * grid_.layer_size();
    return {after ? grid_.size() - count : 0, count};
  }
  /// The value of a node in a seam, in the order of the stars (GridFrame); nothing if the node
  /// never enters.
  std::optional<double> seam_value(std::uint32_t v) const {
    if (!grid_.enters(v) && !grid_.is_t_construction()) return std::nullopt;
    return grid_.value(v);
  }
  /// True if the slab knows the arrow of a node in a seam.
  bool is_known_here(std::uint32_t v) const { return !grid_.is_ghost(v); }
  /// The node to which a step leads. @param u the voxel at the end of the step, or kOutside. @param
  /// sign the direction of the step.
  std::uint32_t or_outside(std::uint32_t u, int sign) const {
    if (u != Grid::kOutside) return u;
    return outside(grid_.open_axes() == 1 && sign > 0 ? 1 : 0);
  }

 protected:
  const Grid& grid_;
};

}  // namespace ph::cubical
