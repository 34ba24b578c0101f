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
  if (top < 2 || !turned_around || !only_components) pair_vertices_with_edges(grid, context, pairs);
  if (top < 2 || (!turned_around && only_components)) return;
  const TakenSquares taken = pair_facets_with_top_cells(grid, context, pairs);
  if (only_components) return;
  if (top == 2) {
    if (!grid.wants_marks()) return;
    // What neither graph takes lives for ever: loops around periodic axes.
    for (const std::uint32_t v : grid.critical())
      for (unsigned rest = grid.tables(v).free_edges(grid.star(v)); rest != 0; rest &= rest - 1)
        pairs.essential(
            1, {v, kEdges[static_cast<std::size_t>(std::countr_zero(rest))], grid.value(v)});
    return;
  }
  LoopReduction<K>(grid, taken, field, context, pairs).run();
}

template void pair_voxels(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                          const BarSink&);
template void pair_voxels(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                          const BarSink&);

}  // namespace ph::cubical
