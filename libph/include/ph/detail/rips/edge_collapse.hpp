// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The storage of the graph while its edges are collapsed; it does not affect the result.
enum class CollapseLayout {
  automatic,  ///< rows if they are affordable, because they are several times as fast
  rows,       ///< rows of n bits
  lists,      ///< lists of neighbours
};

/// Returns a graph that has fewer edges, some of which enter later, and the same persistent
/// homology in every dimension: the flag complexes of the two graphs have the same bars of positive
/// length, over any field.
///
/// An edge is dominated at a value if its link, the common neighbours of its ends, has a vertex
/// that is joined to all its other vertices. Such an edge can be removed from the flag complex
/// without changing homology (Boissonnat & Pritam, Edge collapse and persistence of flag complexes,
/// SoCG 2020). From the longest edge to the shortest, each edge is moved to the first value at
/// which it is not dominated, or dropped if there is none (Glisse & Pritam, Swap, shift and trim to
/// edge collapse a filtration, SoCG 2022). This is repeated on the result as long as many edges are
/// dropped. See docs/explanation/engines/edge-collapse.md for the proof.
///
/// Each edge kept is an edge of `graph`, at its value or at a later value that occurs in `graph`;
/// vertices, their names and the threshold are the same. Among edges of equal value, edges that
/// were moved to that value come first. As a result, the cells that an engine reports for a bar of
/// positive length have its birth and death as their diameters, and its cycles are born and die in
/// the flag complex of `graph` at those values.
///
/// Takes collapse_bytes() and up to 64 bytes per edge kept, 16 of which remain.
/// @throws Error (cancelled) on a stop request; Error (resource) beyond the memory limit.
RipsGraph collapse_edges(const RipsGraph& graph, const RunContext& context = default_context(),
                         CollapseLayout layout = CollapseLayout::automatic);

/// The least memory of a collapse, in bytes: n^2/8, or 16 bytes per edge if that is too much.
double collapse_bytes(const RipsGraph& graph);

/// The share of the edges that are dominated when they enter, from a sample: it predicts the effect
/// of a collapse in a fraction of its time. 0 if the graph has no edges.
double dominated_share(const RipsGraph& graph, const RunContext& context = default_context());

}  // namespace ph
