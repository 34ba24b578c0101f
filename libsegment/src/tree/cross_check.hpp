// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/barcode.hpp"
#include "ph/detail/complex/filtered_graph.hpp"

namespace ph::segment {

/// Computes H0 of the filtration a second time, by reduction of its boundary matrix, and compares:
/// every bar with the vertex that gave birth to it and the edge that killed it; hence the
/// components, too, for the killing edges are a spanning forest.
/// @param barcode what union-find found. @return the first difference in words; empty if none.
std::string cross_check(const FilteredGraph& graph, const Barcode& barcode,
                        const RunContext& context = default_context());

}  // namespace ph::segment
