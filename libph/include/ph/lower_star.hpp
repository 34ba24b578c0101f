// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "ph/explicit.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// The lower-star filtration: a simplex enters with the last of its vertices. The simplices may
/// come without their faces (the triangles of a mesh, say): faces are added. Values of the list are
/// ignored.
/// @param vertex_values a value for each vertex id 0 … size-1, not NaN; +infinity never enters.
/// @throws Error (bad_data) on a vertex id without a value or a NaN, or if sizes disagree.
ExplicitComplex lower_star(const SimplexList& simplices, std::span<const double> vertex_values,
                           const CellNamer& name = {},
                           const RunContext& context = default_context());

/// The lower-star filtration of a graph on vertices 0 … size-1.
ExplicitComplex lower_star(std::span<const WeightedEdge> edges,
                           std::span<const double> vertex_values,
                           const RunContext& context = default_context());

}  // namespace ph
