// SPDX-License-Identifier: MIT
#pragma once
#include <compare>
#include <cstdint>

#include "ph/detail/rips/rips_graph.hpp"

/// The interface that an edge collapse needs from a graph whose edges may move to later values. Two
/// classes implement it, RowGraph and ListGraph; `EdgeCollapse` in edge_collapse.cpp is a template
/// over them.
///
/// Keys represent values: an edge is considered to enter at the key of the last edge that has the
/// same value. A vertex or an edge is present if it has entered by key `now`, which is never less
/// than the key of the current edge.
///
///   Set                           a set of vertices, made by make_set()
///   enter_until(key)              edges up to that key enter; called before everything else
///   find_link(e, now, link)       finds the vertices joined to both ends of e, the current edge
///   find_arrivals(e, now, out)    finds the vertices that are joined to both ends later, with keys
///   are_joined(a, b, now)         true if two vertices are joined by `now`
///   first_apart(link, c, now)     a vertex of the link other than c not joined to c, or kNone
///   keep_neighbours(set, w, now)  removes vertices from a set that are not joined to w
///   move(e, key)                  e enters at a later key, or never
///   leave(e, now)                 to be called after all edges of the same value: e becomes later
namespace ph::collapse {

using Key = RipsGraph::Key;
using Vertex = std::uint32_t;
using Neighbour = RipsAdjacency::Neighbour;
inline constexpr Key kNever = RipsAdjacency::kNever;
inline constexpr Vertex kNone = UINT32_MAX;

/// A vertex that becomes a common neighbour of an edge's two ends, and the key at which it does.
struct Arrival {
  Key key;
  Vertex vertex;
  friend auto operator<=>(const Arrival&, const Arrival&) = default;
};

}  // namespace ph::collapse
