// SPDX-License-Identifier: MIT
#pragma once
#include "alpha/intervals/intervals.hpp"
#include "alpha/listed_simplices.hpp"
#include "ph/alpha.hpp"
#include "ph/explicit.hpp"

namespace ph::alpha {

/// The simplices of a triangulation with values other than alpha, which are not equal within an
/// interval: the square of the radius of the smallest ball around a simplex, or of half its longest
/// edge.
/// @param value any value except alpha. Precondition: no weights.
ExplicitComplex list_with_other_values(const AlphaCells& cells, AlphaOptions::Value value,
                                       const Enters& enters, const RunContext& context);

}  // namespace ph::alpha
