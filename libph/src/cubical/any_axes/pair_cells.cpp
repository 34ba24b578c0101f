// SPDX-License-Identifier: MIT
#include "libph/src/cubical/any_axes/pair_cells.hpp"

#include <algorithm>

#include "libph/src/cubical/any_axes/cell_components.hpp"
#include "libph/src/cubical/columns/boundary_reduction.hpp"
#include "libph/src/cubical/sinks/cell_sink.hpp"
#include "libph/src/cubical/stars/star_matcher.hpp"
#include "libph/src/image/voxels_in_use.hpp"

namespace ph::cubical {
namespace {

using Name = CellGrid::Name;
using Graph = CellComponents::Graph;

/// Pairs the critical cells, dimension by dimension, and keeps the cells that are not paired yet.
class CellPairing {
 public:
  CellPairing(CellGrid& grid, CellSink& sink, const RunContext& context)
      : grid_(grid), sink_(sink), context_(context), left_(mark_cells(grid, context)) {}

  /// Pairs vertices with the edges that kill them.
  void pair_vertices() {
    CellComponents components(grid_, Graph::of_vertices, context_);
    components.join(left_[1], [&](Name edge, std::optional<Name> vertex) {
      const std::uint32_t cell = CellGrid::cell(edge);
      grid_.set_mark(cell, grid_.mark(cell).that_kills());
      sink_.add(0, *vertex, edge);
    });
    for (const Name vertex : left_[0])
      if (components.survives(vertex)) sink_.add(0, vertex, std::nullopt);
  }
  /// Pairs facets with the top cells that kill them. Facets whose class never dies are passed on
  /// without a death.
  void pair_top_cells() {
    const auto top = static_cast<std::size_t>(grid_.dim());
    CellComponents components(grid_, Graph::of_top_cells, context_);
    components.join(left_[top - 1], [&](Name facet, std::optional<Name> cell) {
      sink_.add(grid_.dim() - 1, facet, cell);
    });
    for (const Name cell : left_[top])
      if (components.survives(cell)) sink_.add(grid_.dim(), cell, std::nullopt);
  }
  /// Pairs the remaining cells of dimension `dim` with the cells one dimension higher that kill
  /// them.
  template <Field K>
  void pair_between(int dim, const K& field) {
    const auto k = static_cast<std::size_t>(dim);
    BoundaryReduction<K> reduction(grid_, left_[k + 1], left_[k], field, context_);
    reduction.run([&](Name column, std::optional<Name> row) {
      if (row)
        sink_.add(dim, *row, column);
      else
        sink_.add(dim + 1, column, std::nullopt);
    });
    std::erase_if(left_[k], [&](Name row) { return reduction.is_pivot(row); });
    left_[k + 1] = std::pmr::vector<Name>(&context_.memory);
  }
  /// Passes on the remaining edges, whose classes never die.
  void add_loops() {
    for (const Name edge : left_[1]) sink_.add(1, edge, std::nullopt);
  }

 private:
  CellGrid& grid_;
  CellSink& sink_;
  const RunContext& context_;
  CriticalNames left_;  // indexed by dimension
};

}  // namespace

bool can_pair_cells(const CubicalImage& grid) { return CellGrid::can_hold(grid); }

double bytes_of_cells(const CubicalImage& grid) {
  return sizeof(CellMark) * CellGrid::count_cells(grid);
}

template <Field K>
void pair_cells(const CubicalImage& image, const K& field, int max_dim, bool wants_cells,
                const RunContext& context, const BarSink& bars) {
  const VoxelsInUse voxels_are_read(image, context);
  CellGrid grid(image, context);
  CellSink sink(grid, wants_cells, bars);
  CellPairing pairing(grid, sink, context);
  pairing.pair_vertices();
  if (max_dim > 0) {
    // Pairing starts from the top dimension, because cells that give birth to a class then need no
    // columns. Their columns would be the longest, and would be reduced to zero.
    if (grid.dim() > 1) pairing.pair_top_cells();
    for (int dim = grid.dim() - 2; dim > 0; --dim) pairing.pair_between(dim, field);
    pairing.add_loops();
  }
  sink.finish();
}

template void pair_cells(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                         const BarSink&);
template void pair_cells(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                         const BarSink&);

}  // namespace ph::cubical
