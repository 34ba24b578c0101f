// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <memory_resource>
#include <vector>

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

/// Critical squares that are in pairs with cubes, or live for ever, by position in
/// StarGrid::critical().
using TakenSquares = std::pmr::vector<std::uint16_t>;

/// Components of the sublevel sets: voxels joined by edges, in the order of the stars. Marks the
/// edges that kill.
void pair_vertices_with_edges(StarGrid& grid, const RunContext& context, const PairSink& sink);

/// The same on the dual, backwards: cells of the highest dimension joined by their facets, the
/// youngest first; what never enters and what is outside has always been there. Facets that
/// give birth are marked (edges) or returned (squares). Precondition: grid.top_dim() >= 2.
TakenSquares pair_facets_with_top_cells(StarGrid& grid, const RunContext& context,
                                        const PairSink& sink);

}  // namespace ph::cubical
