// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <numeric>

#include "libph/src/cubical/layers/layer_graphs.hpp"

namespace ph::cubical {

/// The edges of a voxel's star in the graph of voxels. Each thread has its own object.
class VoxelStar {
 public:
  using Nodes = LayerVoxels;

  VoxelStar(const LayerGrid& grid, const Nodes& nodes, std::pmr::memory_resource*)
      : grid_(grid), nodes_(nodes) {}

  void look_at(std::uint32_t v, FoundLinks& found) {
    const LayerGrid::Steps steps(grid_, v);
    find_edges(v, steps);
    if (count_ == 0) {
      found.arrows[v] = v;
      found.roots.push_back({v, v, 0});
      return;
    }
    // The first edge is paired with the voxel. Each other edge joins components unless its ends are
    // already connected, for example through a square.
    found.arrows[v] = edges_[0].leads_to;
    if (count_ == 1) return;
    join_over_squares(v, steps);
    for (std::size_t i = 1; i < count_; ++i)
      if (unite(0, i)) found.bridges.push_back({v, edges_[i].number});
  }

 private:
  struct Edge {
    int axis;
    bool up;
    std::uint32_t far, leads_to, number;
  };

  // Finds the edges of the star in the order of the grid, which begins with the edge downwards
  // along the slowest axis.
  void find_edges(std::uint32_t v, const LayerGrid::Steps& steps) {
    count_ = 0;
    std::uint32_t digit = 1;
    const int axes = grid_.axis_count();
    std::array<std::uint32_t, GridShape::kMostAxes> digits{};
    const auto add = [&](int axis, bool up) {
      const std::uint32_t far = steps.from(v, axis, up);
      if (!grid_.is_older(far, v)) return;
      const std::uint32_t step = up ? 2 : 1;
      edges_[count_++] = {axis, up, far, nodes_.or_outside(far, up ? 1 : -1),
                          step * digits[static_cast<std::size_t>(axis)]};
    };
    for (int a = 0; a < axes; ++a, digit *= 3) {
      digits[static_cast<std::size_t>(a)] = digit;
      if (steps.order(a, 1) < steps.order(a, 0)) add(a, false);
    }
    for (int a = axes - 1; a >= 0; --a) {
      add(a, true);
      if (steps.order(a, 1) > steps.order(a, 0)) add(a, false);
    }
  }
  void join_over_squares(std::uint32_t v, const LayerGrid::Steps& steps) {
    std::iota(same_.begin(), same_.begin() + static_cast<std::ptrdiff_t>(count_), std::size_t{0});
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = i + 1; j < count_; ++j)
        if (edges_[i].axis != edges_[j].axis &&
            grid_.is_older(steps.from(edges_[i].far, edges_[j].axis, edges_[j].up), v))
          unite(i, j);
  }
  std::size_t find(std::size_t i) const {
    while (same_[i] != i) i = same_[i];
    return i;
  }
  // Joins the components of two edges. Returns true if they were separate.
  bool unite(std::size_t i, std::size_t j) {
    i = find(i);
    j = find(j);
    same_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

  const LayerGrid& grid_;
  const Nodes& nodes_;
  std::array<Edge, 2 * std::size_t{GridShape::kMostAxes}> edges_;
  std::array<std::size_t, 2 * std::size_t{GridShape::kMostAxes}> same_{};
  std::size_t count_ = 0;
};

}  // namespace ph::cubical
