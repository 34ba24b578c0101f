// SPDX-License-Identifier: MIT
#pragma once
#include <compare>
#include <cstdint>

#include "ph/detail/rips/rips_graph.hpp"

/// What an edge collapse asks of a graph whose edges may move to later values. Two classes answer,
/// RowGraph and ListGraph; `EdgeCollapse` in edge_collapse.cpp is a template over them.
///
/// Values are known by keys: each edge enters with the last edge of its value, at the key of that
/// edge. A vertex or an edge that has entered by key `now` is there; `now` is never less than the
/// key of the edge at hand.
///
///   Set                           a set of vertices, made by make_set()
///   enter_until(key)              edges up to that key enter; before anything else
///   find_link(e, now, link)       the common neighbours by now of the ends of e, the edge at hand
///   find_arrivals(e, now, out)    those that come later, each with the key at which it does
///   are_joined(a, b, now)         whether two vertices are joined by now
///   first_apart(link, c, now)     a vertex of the link other than c not joined to c, or kNone
///   keep_neighbours(set, w, now)  takes out of a set what is not joined to w
///   move(e, key)                  e enters at a later key, or never
///   leave(e, now)                 all edges of its value are done: from now on e comes later
namespace ph::collapse {

using Key = RipsGraph::Key;
using Vertex = std::uint32_t;
using Neighbour = RipsAdjacency::Neighbour;
inline constexpr Key kNever = RipsAdjacency::kNever;
inline constexpr Vertex kNone = UINT32_MAX;

/// A vertex that becomes a common neighbour.
struct Arrival {
  Key key;
  Vertex vertex;
  friend auto operator<=>(const Arrival&, const Arrival&) = default;
};

}  // namespace ph::collapse
