// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <memory_resource>
#include <vector>

#include "pair_components.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// Receives pairs of the stars' grid, by dimension of the birth.
struct PairSink {
  /// A class of dimension `dim` born with a cell, killed by a cell one dimension higher. Not called
  /// where both have the same value.
  std::function<void(int dim, const StarCell& birth, const StarCell& death)> pair;
  /// A class that never dies.
  std::function<void(int dim, const StarCell& birth)> essential;
};

using NumberedCells = std::pmr::vector<NumberedCell>;

/// The cells of a dimension (1 or 2) that are not paired inside their stars, by (value, place).
NumberedCells critical_cells(const StarGrid& grid, int dim, const RunContext& context);

/// Components of the sublevel sets: voxels joined by edges, in the order of the stars. Takes the
/// edges that kill from `edges`, all critical ones; of three axes it marks them in the grid.
void pair_vertices_with_edges(StarGrid& grid, NumberedCells& edges, const RunContext& context,
                              const PairSink& sink);

/// The same on the dual, backwards: cells of the highest dimension joined by their facets, the
/// youngest first; what never enters and what is outside has always been there. Takes the facets
/// that give birth from `facets`, all critical ones that kill nothing. Precondition: grid.top_dim()
/// >= 2.
void pair_facets_with_top_cells(const StarGrid& grid, NumberedCells& facets,
                                const RunContext& context, const PairSink& sink);

}  // namespace ph::cubical
