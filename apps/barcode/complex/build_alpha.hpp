// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "barcode/complex/build_complex.hpp"
#include "ph/points.hpp"

namespace ph::barcode {

/// The alpha complex of points, or another complex of their Delaunay triangulation.
/// @param weights one per point, or none. @param ids of the points in the input; empty: their own
///     numbers.
/// @throws Error (usage) if an option does not fit the points; Error (bad_data).
BuiltComplex build_alpha(const Points& points, std::vector<double> weights,
                         const std::vector<Index>& ids, const std::string& name,
                         const Arguments& arguments, const RunContext& context);

}  // namespace ph::barcode
