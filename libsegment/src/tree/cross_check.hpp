// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/barcode.hpp"
#include "ph/detail/complex/filtered_graph.hpp"

namespace ph::segment {

/// Computes H0 of the filtration a second time by reducing its boundary matrix, and compares every
/// bar with its birth vertex and its death edge. This also compares the components, because the
/// death edges form a spanning forest.
/// @param barcode the result of union-find. @return a description of the first difference, or an
/// empty text if there is no difference.
std::string cross_check(const FilteredGraph& graph, const Barcode& barcode,
                        const RunContext& context = default_context());

}  // namespace ph::segment
