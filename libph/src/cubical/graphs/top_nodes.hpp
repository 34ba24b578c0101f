// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "libph/src/cubical/grid/grid_frame.hpp"

namespace ph::cubical {

/// The nodes of a graph of top cells. They are the cells of the highest dimension, numbered by
/// their first corner, and the outside, which has two parts if only one axis has ends. The outside
/// and the cells that never enter were always there.
/// @tparam Grid a SlabFrame that knows which voxels enter. @tparam most the size of arrays that are
/// indexed by axis: three, or the maximum number of axes.
template <class Grid, std::size_t most>
class TopNodes {
 public:
  static constexpr bool kBackwards = true;
  /// The direction from a voxel to a cell, by axis.
  using Way = std::array<int, most>;

  explicit TopNodes(const Grid& grid) : grid_(grid) {
    for (std::size_t a = axes(); a-- > 0;) {
      const int axis = static_cast<int>(a);
      // With a border around the voxels, an axis has one cell more than it has voxels.
      const bool has_border =
          grid.is_t_construction() && grid.has_axis(axis) && !grid.is_periodic(axis);
      border_[a] = has_border ? 1 : 0;
      extent_[a] = grid.extent(axis) + border_[a];
      stride_[a] = count_;
      by_extent_[a] = Divisor(extent_[a]);
      count_ *= extent_[a];
    }
  }

  std::size_t size() const { return std::size_t{count_} + 2; }
  std::uint32_t outside(int part) const { return count_ + static_cast<std::uint32_t>(part); }
  /// True if nodes other than the outside were always there.
  bool has_outer_nodes() const { return !grid_.is_t_construction() && !grid_.all_enter(); }
  /// Calls `use(node)` for all top cells around a voxel that never enters. These nodes are
  /// connected.
  template <class Use>
  void for_each_outer_node(std::uint32_t v, Use&& use) const;
  /// The nodes that a slab shares with the preceding or the following slab, as in VoxelNodes. They
  /// are the top cells between the ghost layer and the layer beside it.
  std::array<std::uint32_t, 2> seam(bool after) const {
    const int axis = grid_.layer_axis();
    const auto a = static_cast<std::size_t>(axis);
    const std::uint32_t layer = border_[a] + (after ? grid_.extent(axis) - 2 : 0);
    return {layer * stride_[a], stride_[a]};
  }
  std::optional<double> seam_value(std::uint32_t node) const;
  /// The top cell in a direction from a voxel.
  std::uint32_t node(std::uint32_t v, const Way& d) const;

 protected:
  std::size_t axes() const {
    return most == 3 ? most : static_cast<std::size_t>(grid_.axis_count());
  }
  /// Calls `use(voxel, direction from the voxel)` for the corners of a top cell until `use` returns
  /// true.
  template <class Use>
  void for_each_corner(std::uint32_t node, Use&& use) const;

  const Grid& grid_;
  std::array<std::uint32_t, most> extent_{}, stride_{}, border_{};

 private:
  /// True if a cell has this number. No cell comes after the last voxels of an axis with ends.
  bool is_cell(std::uint32_t node) const;
  std::uint32_t outside_beyond(const Way& d) const {
    if (grid_.open_axes() == 1)
      for (std::size_t a = 0; a < axes(); ++a)
        if (grid_.has_ends(static_cast<int>(a)) && d[a] > 0) return outside(1);
    return outside(0);
  }

  std::array<Divisor, most> by_extent_;
  std::uint32_t count_ = 1;
};

template <class Grid, std::size_t most>
std::uint32_t TopNodes<Grid, most>::node(std::uint32_t v, const Way& d) const {
  std::uint32_t result = 0;
  for (std::size_t a = 0; a < axes(); ++a) {
    const int axis = static_cast<int>(a);
    if (!grid_.has_axis(axis)) continue;
    const std::uint32_t x = grid_.coordinate(v, axis), last = grid_.extent(axis) - 1;
    std::uint32_t low = x + border_[a];
    if (d[a] < 0) {
      if (low > 0)
        --low;
      else if (grid_.is_periodic(axis))
        low = last;
      else
        return outside_beyond(d);
    } else if (x == last && border_[a] == 0 && !grid_.is_periodic(axis)) {
      return outside_beyond(d);
    }
    result += low * stride_[a];
  }
  return result;
}

template <class Grid, std::size_t most>
template <class Use>
void TopNodes<Grid, most>::for_each_corner(std::uint32_t node, Use&& use) const {
  std::array<std::uint32_t, most> low{};
  for (std::size_t a = axes(); a-- > 0;) {
    const std::uint32_t rest = by_extent_[a].divide(node);
    low[a] = node - rest * extent_[a];
    node = rest;
  }
  for (unsigned corner = 0; corner < 1U << axes(); ++corner) {
    Way d{};
    std::uint32_t v = 0;
    bool is_there = true;
    for (std::size_t a = 0; a < axes(); ++a) {
      const int axis = static_cast<int>(a);
      const std::uint32_t upper = corner >> a & 1U, n = grid_.extent(axis);
      if (!grid_.has_axis(axis)) {
        is_there = is_there && upper == 0;
        continue;
      }
      d[a] = upper != 0 ? -1 : 1;
      std::uint32_t x = low[a] + upper;
      if (border_[a] != 0) {
        is_there = is_there && x >= 1 && x <= n;
        --x;
      } else if (x == n) {
        x = 0;  // the axis is periodic
      }
      v = v * n + x;
    }
    if (is_there && use(v, d)) return;
  }
}

template <class Grid, std::size_t most>
template <class Use>
void TopNodes<Grid, most>::for_each_outer_node(std::uint32_t v, Use&& use) const {
  for (unsigned above = 0; above < 1U << axes(); ++above) {
    Way d{};
    // Of the directions that differ only along missing axes, only the first is used.
    bool is_first = true;
    for (std::size_t a = 0; a < axes(); ++a) {
      const bool is_above = (above >> (axes() - 1 - a) & 1U) != 0;
      if (grid_.has_axis(static_cast<int>(a)))
        d[a] = is_above ? 1 : -1;
      else
        is_first = is_first && !is_above;
    }
    if (is_first) use(node(v, d));
  }
}

template <class Grid, std::size_t most>
bool TopNodes<Grid, most>::is_cell(std::uint32_t node) const {
  for (std::size_t a = axes(); a-- > 0;) {
    const int axis = static_cast<int>(a);
    const std::uint32_t rest = by_extent_[a].divide(node), low = node - rest * extent_[a];
    if (grid_.has_axis(axis) && border_[a] == 0 && !grid_.is_periodic(axis) &&
        low + 1 == extent_[a])
      return false;
    node = rest;
  }
  return true;
}

template <class Grid, std::size_t most>
std::optional<double> TopNodes<Grid, most>::seam_value(std::uint32_t node) const {
  std::optional<double> youngest;
  if (!is_cell(node)) return youngest;  // mutant: seam-cell
  for_each_corner(node, [&](std::uint32_t v, const Way&) {
    // In the T-construction, cells that never enter were always there.
    if (grid_.enters(v) || !grid_.is_t_construction())
      youngest = std::max(youngest.value_or(grid_.value(v)), grid_.value(v));
    return false;
  });
  return youngest;
}

}  // namespace ph::cubical
