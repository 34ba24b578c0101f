// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "ph/alpha.hpp"
#include "ph/explicit.hpp"

namespace ph::alpha {

/// True if a simplex of that squared radius enters.
using Enters = std::function<bool(double)>;

/// All simplices that enter, by dimension and then by vertices, the last one first. Values are
/// squared radii in the units of the sites.
ExplicitComplex list_simplices(const AlphaCells& cells, const Enters& enters,
                               const RunContext& context);

/// The same for a periodic space, whose cells are not determined by their vertices.
/// @param vertices receives the vertices of each cell, ascending.
ExplicitComplex list_cells(const AlphaCells& cells, const Enters& enters, SimplexList& vertices,
                           const RunContext& context);

/// The highest dimension of a simplex that enters, or -1 if none does.
int top_dim(const AlphaCells& cells, const Enters& enters);

/// Number of all simplices by dimension, including edges to copies.
std::vector<std::size_t> simplex_counts(const AlphaCells& cells);

/// The simplices of a triangulation with values other than alpha, which are not equal within an
/// interval: the square of the radius of the smallest ball around a simplex, or of half its longest
/// edge.
/// @param value any value except alpha. Precondition: no weights.
ExplicitComplex list_with_other_values(const AlphaCells& cells, AlphaOptions::Value value,
                                       const Enters& enters, const RunContext& context);

}  // namespace ph::alpha
