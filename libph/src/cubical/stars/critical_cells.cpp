// SPDX-License-Identifier: MIT
#include "libph/src/cubical/stars/critical_cells.hpp"

namespace ph::cubical {

CriticalCells critical_cells(const StarGrid& grid, int dim, const RunContext& context) {
  CriticalCells critical(&context.memory);
  critical.cells.reserve(grid.critical().size());  // most of these voxels have one critical cell
  Ticker ticker(context, {});
  for (const std::uint32_t v : grid.critical()) {
    ticker.work();
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
  put_in_order(critical, grid, context);
  return critical;
}

void mark_paired(StarGrid& grid, const CriticalCells& edges) {
  std::pmr::vector<bool> is_left(edges.cells.size(), false, edges.cells.get_allocator());
  for (const CriticalCells::Place& place : edges.order) is_left[place.cell] = true;
  for (std::size_t i = 0; i < is_left.size(); ++i) {
    if (is_left[i]) continue;
    const auto [v, number] = edges.cells[i];
    grid.mark(v, grid.tables(v).taken_mark(static_cast<int>(number)));
  }
}

void mark_all_but(StarGrid& grid, const FreeEdges& free, std::uint32_t begin, std::uint32_t end) {
  for (const std::uint32_t v : grid.critical()) {
    if (v < begin || v >= end) continue;
    const StarTables& tables = grid.tables(v);
    tables.edge_order().for_each(tables.critical_edges(grid.star(v)) & ~free.edges(v),
                                 [&](int edge) { grid.mark(v, tables.taken_mark(edge)); });
  }
}

FreeEdges free_edges(const StarGrid& grid, const RunContext& context) {
  FreeEdges free(grid, context);
  for (const std::uint32_t v : grid.critical())
    free.add(v, grid.tables(v).free_edges(grid.star(v)));
  free.finish();
  return free;
}

}  // namespace ph::cubical
