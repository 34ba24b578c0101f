// SPDX-License-Identifier: MIT
#include "ph/cubical/pair_voxels.hpp"

#include "loop_reduction.hpp"

namespace ph::cubical {

bool can_pair_voxels(const CubicalImage& grid) { return StarGrid::can_hold(grid); }

template <Field K>
void pair_voxels(const CubicalImage& voxels, const K& field, int max_dim, bool wants_cells,
                 const RunContext& context, const BarSink& sink) {
  StarGrid grid(voxels, context);
  const int top = grid.top_dim();
  const bool turned_around = grid.relative();
  const auto value = [&](const StarCell& cell) {
    return (turned_around ? -cell.value : cell.value) + 0.0;
  };
  PairSink pairs;
  pairs.pair = [&](int dim, const StarCell& birth, const StarCell& death) {
    const StarCell& first = turned_around ? death : birth;
    const StarCell& second = turned_around ? birth : death;
    const Bar bar{turned_around ? top - dim - 1 : dim, value(first), value(second)};
    grid.for_each_copy(first, &second, wants_cells, [&](const auto& a, const auto& b, int shift) {
      sink({bar.dim + shift, bar.birth, bar.death}, a, b);
    });
  };
  pairs.essential = [&](int dim, const StarCell& birth) {
    const Bar bar{turned_around ? top - dim : dim, value(birth), kInfinity};
    grid.for_each_copy(birth, nullptr, wants_cells, [&](const auto& a, const auto& b, int shift) {
      sink({bar.dim + shift, bar.birth, bar.death}, a, b);
    });
  };
  // Components come from one graph, the highest dimension from the other; turned around they have
  // changed places.
  const bool only_components = max_dim == 0;
  const bool takes_voxels = top < 2 || !turned_around || !only_components;
  NumberedCells edges(&context.memory);
  if (takes_voxels || top == 2) edges = critical_cells(grid, 1, context);
  if (takes_voxels) pair_vertices_with_edges(grid, edges, context, pairs);
  if (top > 1 && (turned_around || !only_components)) {
    NumberedCells squares(&context.memory);
    if (top == 3) squares = critical_cells(grid, 2, context);
    pair_facets_with_top_cells(grid, top == 3 ? squares : edges, context, pairs);
    if (top == 3 && !only_components) LoopReduction<K>(grid, squares, field, context, pairs).run();
  }
  // What neither graph takes lives for ever: loops around periodic axes.
  if (top == 3 || (top == 2 && only_components)) return;
  for (const NumberedCell& e : edges) pairs.essential(1, {e.voxel, kEdges[e.number], e.value});
}

template void pair_voxels(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                          const BarSink&);
template void pair_voxels(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                          const BarSink&);

}  // namespace ph::cubical
