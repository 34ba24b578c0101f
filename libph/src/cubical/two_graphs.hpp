// SPDX-License-Identifier: MIT
#pragma once
#include "critical_cells.hpp"
#include "pair_sink.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// Components of the sublevel sets: voxels joined by edges, in the order of the stars. Takes the
/// edges that kill from the order of `edges`, all critical ones; of three axes it marks them in the
/// grid.
void pair_vertices_with_edges(StarGrid& grid, CriticalCells& edges, const RunContext& context,
                              PairSink& sink);

/// The same on the dual, backwards: cells of the highest dimension joined by their facets, the
/// youngest first; what never enters and what is outside has always been there. Takes the facets
/// that give birth from the order of `facets`, all critical ones that kill nothing. Precondition:
/// grid.top_dim() >= 2.
void pair_facets_with_top_cells(const StarGrid& grid, CriticalCells& facets,
                                const RunContext& context, PairSink& sink);

}  // namespace ph::cubical
