// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "ph/alpha.hpp"
#include "ph/explicit.hpp"

namespace ph::alpha {

/// True if a simplex with this squared radius enters the filtration.
using Enters = std::function<bool(double)>;

/// Lists all simplices that enter the filtration. They are sorted by dimension and then by sites,
/// where the largest site counts most. Copies of sites and the edges to them come last in their
/// dimensions. Values are squared radii in the units of the sites.
ExplicitComplex list_simplices(const AlphaCells& cells, const Enters& enters,
                               const RunContext& context);

/// Lists the cells of a periodic space, where several cells may have the same vertices.
/// @param vertices receives the vertices of each cell, ascending.
ExplicitComplex list_cells(const AlphaCells& cells, const Enters& enters, SimplexList& vertices,
                           const RunContext& context);

/// The highest dimension of a simplex that enters the filtration, or -1 if no simplex enters.
int top_dim(const AlphaCells& cells, const Enters& enters);

/// The number of simplices in each dimension, including copies of sites and the edges to them.
std::vector<std::size_t> simplex_counts(const AlphaCells& cells);

/// Lists the simplices of a triangulation with values other than alpha values. The value of a
/// simplex is the squared radius of the smallest ball around it, or the squared half-length of its
/// longest edge. Simplices of the same interval may have different values of this kind.
/// @param value any value except alpha. Precondition: the points have no weights.
ExplicitComplex list_with_other_values(const AlphaCells& cells, AlphaOptions::Value value,
                                       const Enters& enters, const RunContext& context);

}  // namespace ph::alpha
