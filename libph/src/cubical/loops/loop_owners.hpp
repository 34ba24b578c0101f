// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/columns/ordered_cell.hpp"
#include "libph/src/cubical/grid/grid_frame.hpp"
#include "libph/src/cubical/stars/free_edges.hpp"

namespace ph::cubical {

/// For each free edge, the column whose pivot is this edge, or null.
/// @tparam Stars as in LoopColumn.
template <class Stars, class Column>
class LoopOwners {
 public:
  LoopOwners(const Stars& grid, const FreeEdges& free, const RunContext& context)
      : grid_(grid), free_(free), owners_(free.count(), nullptr, &context.memory) {}

  /// The entry for the column with this pivot.
  const Column*& of(const LoopEdge& pivot) {
    const std::uint32_t v = grid_.here(pivot.voxel());
    return owners_[free_.number(v, grid_.tables(v).edge_order().at(pivot.rank()))];
  }
  /// Prefetches the data that `of` reads.
  void expect(const LoopEdge& pivot) const { free_.prefetch(grid_.here(pivot.voxel())); }
  StarCell cell(const LoopEdge& edge) const {
    const std::uint32_t v = grid_.here(edge.voxel());
    return {v, kEdges[grid_.tables(v).edge_order().at(edge.rank())], edge.value()};
  }
  /// Calls `use(edge, column)` for all free edges.
  template <class Use>
  void for_each(Use&& use) const {
    auto owner = owners_.begin();
    free_.for_each([&](std::uint32_t v, unsigned edges) {
      for (; edges != 0; edges &= edges - 1, ++owner)
        use(StarCell{v, kEdges[std::countr_zero(edges)], grid_.value(v)}, *owner);
    });
  }

 private:
  const Stars& grid_;
  const FreeEdges& free_;
  std::pmr::vector<const Column*> owners_;  // indexed by the number of the edge
};

}  // namespace ph::cubical
