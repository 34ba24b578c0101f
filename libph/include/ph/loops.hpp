// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/core/loop.hpp"
#include "ph/persistence.hpp"

namespace ph {

/// The loops of the bars of H1, as walks from vertex to vertex.
///
/// With tightening, loops of a Rips filtration become as short as moderate work allows. Loops of
/// all other complexes, and loops of bars of length zero, are the bar's chain, split by
/// `closed_walks`. The loops of a bar [b, d) sum to a cycle of edges of value <= b, in which the
/// birth cell occurs as often as in the chain. This cycle is homologous to the chain in the complex
/// just before d, or in the last complex if the bar never dies; it therefore represents the bar as
/// well as the chain does. Tightness::shortest compares the loop with all closed walks that pass
/// the birth cell once, continue along older edges, and give such a cycle when multiplied by the
/// coefficient of the birth cell: none of these walks is shorter. The length of a walk is the sum
/// of the values of its edges.
///
/// The method: A closed walk through the birth edge consists of this edge and a path between its
/// ends. The walk is homologous to the chain, in the sense above, if all cocycles that are born
/// before the bar and live at least as long as the bar have the same value on both. (Persistent
/// cohomology has a basis of cocycles at every value.) Usually there are no such cocycles, and the
/// shortest path solves the problem. Otherwise the path is searched for in the cover whose sheets
/// are the values of the cocycles. If computing the cocycles or that search would take too long,
/// the loop is changed step by step over existing triangles. This choice depends on numbers of
/// steps, never on time: the result is a function of the input.
///
/// Takes O(edges up to the last birth) memory and at most a few times 10^8 steps. If the memory
/// limit does not allow this, loops are not tightened, and may even have no lengths.
///
/// @param cycles the bars of the complex, computed with Representatives::cycles, or with ::voxels,
///        where only bars with a cycle get loops. @param options the options with which the bars
///        were computed, or RunPlan::options, which make a new plan unnecessary and shorten the
///        search. @param tighten true if loops should be tightened.
/// @return the loops of each bar; no loops for bars of other dimensions, bars without a chain, or
///         bars whose cells are rows of a boundary matrix.
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
