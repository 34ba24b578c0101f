// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <tuple>
#include <vector>

#include "libph/src/cubical/loops/loop_reduction.hpp"
#include "libph/src/cubical/slabs/free_cells.hpp"
#include "libph/src/cubical/slabs/stored_stars.hpp"
#include "ph/detail/core/radix_sort.hpp"

namespace ph::cubical {

/// Collects the data that loops need from the slabs of a grid with three axes: the stars, and the
/// critical edges and squares that neither graph pairs.
class SlabLoops final : public FreeCellSink {
 public:
  SlabLoops(const GridFrame& frame, const RunContext& context)
      : context_(context), stars_(frame), edges_(&context.memory), squares_(&context.memory) {}

  void add_stars(const StarGrid& slab, std::uint32_t first) { stars_.add(slab, first); }
  void add_edge(const GridCell& edge) override { edges_.push_back(numbered(edge)); }
  void add_square(double value, const GridCell& square) override {
    squares_.push_back({value, numbered(square)});
  }
  /// Computes the bars of loops, once all slabs have been added. @throws Error (resource) if memory
  /// is too small for the columns.
  template <Field K>
  void pair(const K& field, PairSink& pairs) {
    const FreeEdges free = free_edges();
    stars_.mark_all_but(free, context_);
    const CriticalCells squares = sorted_squares();
    // A third of the remaining memory is for stars and voxels. The rest is for columns.
    const MemoryClaim pages(context_.memory, context_.memory.left() / 3);
    stars_.let_stay(pages.bytes());
    LoopReduction<K, StoredStars>(stars_, free, squares, field, context_).run(pairs);
  }

 private:
  struct Square {
    double value;
    NumberedCell cell;
  };

  static NumberedCell numbered(const GridCell& cell) {
    return {static_cast<std::uint32_t>(cell.voxel()), cell.number()};
  }
  FreeEdges free_edges() {
    std::ranges::sort(edges_, {}, &NumberedCell::voxel);
    FreeEdges free(stars_, context_);
    for (std::size_t i = 0; i < edges_.size();) {
      const std::uint32_t v = edges_[i].voxel;
      unsigned numbers = 0;
      for (; i < edges_.size() && edges_[i].voxel == v; ++i) numbers |= 1U << edges_[i].number;
      free.add(v, numbers);
    }
    free.finish();
    edges_ = decltype(edges_)(&context_.memory);
    return free;
  }
  CriticalCells sorted_squares() {
    std::ranges::sort(squares_, {}, [&](const Square& square) {
      const auto [voxel, number] = square.cell;
      return std::tuple(voxel, stars_.tables(voxel).square_order().rank(static_cast<int>(number)));
    });
    CriticalCells result(&context_.memory);
    result.cells.reserve(squares_.size());
    result.order.reserve(squares_.size());
    for (const auto& [value, cell] : squares_) {
      result.order.push_back({value, static_cast<std::uint32_t>(result.cells.size())});
      result.cells.push_back(cell);
    }
    squares_ = decltype(squares_)(&context_.memory);
    radix_sort_by_value(
        result.order, [](const CriticalCells::Place& place) { return place.value; }, context_);
    return result;
  }

  const RunContext& context_;
  StoredStars stars_;
  std::pmr::vector<NumberedCell> edges_;
  std::pmr::vector<Square> squares_;
};

}  // namespace ph::cubical
