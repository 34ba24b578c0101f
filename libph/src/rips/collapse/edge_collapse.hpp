// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// How the graph is kept while its edges are collapsed; the result is the same.
enum class CollapseLayout {
  automatic,  ///< rows where they are affordable: they are several times as fast
  rows,       ///< rows of n bits
  lists,      ///< lists of neighbours
};

/// Fewer edges, some of them later, with the same persistent homology in every dimension: the flag
/// complexes of the two graphs have the same bars of positive length, over any field.
///
/// An edge is dominated at a value if its link, the common neighbours of its ends, has a vertex
/// joined to all others: then it can be taken out of the flag complex without changing homology
/// (Boissonnat & Pritam, Edge collapse and persistence of flag complexes, SoCG 2020). From the
/// longest edge to the shortest, each edge is moved to the first value at which it is not
/// dominated, or dropped if there is none (Glisse & Pritam, Swap, shift and trim to edge collapse a
/// filtration, SoCG 2022); and so again on what is left, as long as many edges are dropped. See
/// docs/explanation/engines/edge-collapse.md for the proof.
///
/// Each edge kept is one of `graph`, at its value or a later one that occurs in `graph`; vertices,
/// their names and the threshold are the same. Among edges of one value those that were moved there
/// come first: so the cells that an engine reports for a bar of positive length have the diameter
/// that the bar says, and its cycles are born and die in the flag complex of `graph` as it says.
///
/// Takes collapse_bytes() and up to 64 bytes for each edge kept, of which 16 stay.
/// @throws Error (cancelled) on a stop request; Error (resource) beyond the memory limit.
RipsGraph collapse_edges(const RipsGraph& graph, const RunContext& context = default_context(),
                         CollapseLayout layout = CollapseLayout::automatic);

/// What a collapse takes at least, in bytes: n^2/8, or where that is too much 16 bytes an edge.
double collapse_bytes(const RipsGraph& graph);

/// Which share of the edges is dominated when they enter, from a sample of them: a forecast of what
/// a collapse can do in a fraction of its time. 0 for a graph without edges.
double dominated_share(const RipsGraph& graph, const RunContext& context = default_context());

}  // namespace ph
