// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/core/loop.hpp"
#include "ph/persistence.hpp"

namespace ph {

/// The loops of the bars of H1, as walks from vertex to vertex.
///
/// Tightened, loops of a Rips filtration are as short as is cheap; all others, and those of bars of
/// length zero, are the chain taken apart by `closed_walks`. The loops of a bar [b, d) sum to a
/// cycle of edges of value <= b with the birth cell among them, as often as in the chain. It is
/// homologous to the chain in the complex just before d, or in the last one if the bar never dies:
/// so it represents the bar as well as the chain does. Tightness::shortest says that no closed walk
/// is shorter that passes the birth cell once, goes on along older edges, and with the coefficient
/// of the birth cell is such a cycle; lengths are sums of the values of edges.
///
/// How. A closed walk through the birth edge is a path between its ends. It is homologous to the
/// chain as said if all cocycles agree on both that are born before and live at least as long
/// (persistent cohomology has a basis of cocycles at every value). Mostly there is none, and the
/// shortest path will do; else paths are looked for in the cover whose sheets are the values of the
/// cocycles. Where cocycles or that search would take too long, steps are taken over triangles that
/// are there. Decided by counting steps, never by time: the result is a function of the input.
///
/// O(edges up to the last birth) memory, and a few times 10^8 steps at most. If the memory limit
/// does not allow it, loops stay as they are, without lengths if need be.
///
/// @param cycles the bars of that complex with Representatives::cycles (or ::voxels: bars with a
///        cycle get loops). @param options with which they were computed, or RunPlan::options,
///        which plans nothing anew and leaves less to search. @param tighten whether loops are
///        tightened.
/// @return by bar; nothing for bars of other dimensions, without a chain, or whose cells are rows
///         of a boundary matrix.
/// @throws Error (usage) if the bars have no cycles; Error (resource, cancelled).
std::vector<BarLoops> loops(const Rips& rips, const Barcode& cycles, const Options& options = {},
                            bool tighten = true, const RunContext& context = default_context());
std::vector<BarLoops> loops(const Cubical& cubical, const Barcode& cycles,
                            const Options& options = {}, bool tighten = true,
                            const RunContext& context = default_context());
std::vector<BarLoops> loops(const ExplicitComplex& complex, const Barcode& cycles,
                            const Options& options = {}, bool tighten = true,
                            const RunContext& context = default_context());
std::vector<BarLoops> loops(const Alpha& alpha, const Barcode& cycles, const Options& options = {},
                            bool tighten = true, const RunContext& context = default_context());
std::vector<BarLoops> loops(const AnyComplex& complex, const Barcode& cycles,
                            const Options& options = {}, bool tighten = true,
                            const RunContext& context = default_context());

}  // namespace ph
