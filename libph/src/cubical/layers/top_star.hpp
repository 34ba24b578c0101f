// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "libph/src/cubical/layers/layer_graphs.hpp"
#include "libph/src/cubical/stars/star_matcher.hpp"

namespace ph::cubical {

/// The top cells and facets of a voxel's star in the graph of top cells. Each thread has its own
/// object.
///
/// All top cells around a voxel, including those outside its star, are joined as in the graph. They
/// are joined first by the facets of younger voxels, then by the facets of the star, youngest
/// first. A facet of the star that joins two trees in a pair of length zero gives an arrow. A facet
/// whose two sides are already connected at that time joins no components of the entire grid.
class TopStar {
 public:
  using Nodes = LayerTops;

  TopStar(const LayerGrid& grid, const Nodes& nodes, std::pmr::memory_resource* memory);
  void look_at(std::uint32_t v, FoundLinks& found);

 private:
  struct Cell {
    std::uint16_t code;
    std::uint32_t far;  // the voxel at the end of all steps of the cell
  };
  /// A cell that can be sorted by the order of the grid.
  struct Placed {
    std::uint32_t place, which;
    friend auto operator<=>(const Placed&, const Placed&) = default;
  };
  /// The top cells around a voxel are numbered by their sides: bit a is set if the cell is above
  /// the voxel along axis a.
  std::uint32_t code_of(std::uint32_t sides) const { return codes_[sides]; }
  std::uint32_t code_of_facet(std::uint32_t sides, int normal) const {
    const auto a = static_cast<std::size_t>(normal);
    return codes_[sides] - ((sides >> a & 1U) + 1) * shapes_.digit[a];
  }
  std::uint32_t place(std::uint32_t code, const LayerGrid::Steps& steps) const;
  std::uint32_t node(std::uint32_t v, std::uint32_t sides) const;
  void find_cells(std::uint32_t v, const LayerGrid::Steps& steps);
  void join_by_younger_facets();
  void join_by_facet(std::uint32_t v, std::uint32_t code, FoundLinks& found);

  std::uint32_t find(std::uint32_t sides) const {
    while (same_[sides] != sides) sides = same_[sides];
    return sides;
  }

  const LayerGrid& grid_;
  const Nodes& nodes_;
  const int axes_;
  StarShapes shapes_;
  std::pmr::vector<std::uint16_t> codes_;  // indexed by sides
  // The cells of the star, in an order in which each cell comes after the cells that have one step
  // fewer.
  std::pmr::vector<Cell> cells_;
  std::pmr::vector<std::uint8_t> is_in_;  // for each code, 1 if the cell is in the star
  std::pmr::vector<Placed> facets_, tops_;
  // For each set of sides, the tree of the top cell and the age of the tree. If all cells of a tree
  // are in the star, its root is the youngest cell, which is the elder in this reverse order. Any
  // other tree is older than the star.
  std::pmr::vector<std::uint32_t> same_, age_;
  std::pmr::vector<std::uint8_t> is_new_;
};

}  // namespace ph::cubical
