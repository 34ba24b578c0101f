// SPDX-License-Identifier: MIT
#include "critical_cells.hpp"

#include "ph/core/radix_sort.hpp"

namespace ph::cubical {

CriticalCells critical_cells(const StarGrid& grid, int dim, const RunContext& context) {
  CriticalCells critical(&context.memory);
  critical.cells.reserve(grid.critical().size());  // one each, about
  Ticker ticker(context, "critical cells", grid.critical().size());
  for (const std::uint32_t v : grid.critical()) {
    ticker.tick();
    const StarTables& tables = grid.tables(v);
    const auto add = [&](int number) {
      critical.cells.push_back({v, static_cast<std::uint32_t>(number)});
    };
    if (dim == 1)
      tables.edge_order().for_each(tables.critical_edges(grid.star(v)), add);
    else
      tables.square_order().for_each(tables.critical_squares(grid.star(v), grid.pair_cubes(v)),
                                     add);
  }
  critical.order.resize(critical.cells.size());
  for (std::uint32_t i = 0; i < critical.cells.size(); ++i)
    critical.order[i] = {grid.value(critical.cells[i].voxel), i};
  radix_sort_by_value(
      critical.order, [](const CriticalCells::Place& place) { return place.value; }, context);
  return critical;
}

}  // namespace ph::cubical
