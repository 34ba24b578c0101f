// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// A closed walk along edges: from vertex to vertex, and from the last one back to the first, which
/// is not repeated. It stands for a chain: an edge that it takes from its first vertex to its
/// second (along its grid axis, for a cube) counts `coefficient`, one that it takes the other way
/// the opposite.
struct Loop {
  /// The numbers of the vertices, one after another: one each (CellKind::vertices), or the doubled
  /// coordinates (CellKind::grid).
  std::vector<Index> numbers;
  std::int64_t coefficient = 1;
  /// The sum of the values of its edges, where values are lengths.
  std::optional<double> length = std::nullopt;
  friend bool operator==(const Loop&, const Loop&) = default;
};

/// How much is known of the length of loops.
enum class Tightness {
  none,      ///< nothing
  locally,   ///< no step over one or two triangles shortens one of them
  shortest,  ///< no closed walk that could stand in their place is shorter, see ph/loops.hpp
};

/// The loops of a bar of H1: with their coefficients they sum to a cycle that represents it.
struct BarLoops {
  std::vector<Loop> loops;
  Tightness tightness = Tightness::none;
};

/// What loops hold.
std::size_t bytes_of(std::span<const BarLoops> loops);

/// Takes a cycle of edges apart. With their coefficients the walks sum to the cycle, edge by edge;
/// each passes no vertex twice. Over Z/2 no edge is in two of them. A function of the chain alone:
/// a walk begins with its smallest vertex and goes on to the smaller one of its two neighbours
/// (Z/2), or as its coefficient is positive (Z/p); walks come by descending number of steps, then
/// by vertices. O(edges) over Z/2; over Z/p a walk may be as long for each edge.
///
/// Vertices do not tell an edge where a periodic axis has one voxel (a walk of one vertex and one
/// step) or two (two edges join them).
/// @param field the characteristic of the coefficients.
/// @param periods of grid cells: by axis, how many doubled coordinates there are if the axis is
///        periodic, else 0; empty: no axis is.
/// @throws Error (usage) if the cells are no edges, rows of a boundary matrix among them, or if the
///         boundary of the chain is not zero; Error (resource, cancelled).
std::vector<Loop> closed_walks(const InputChain& cycle, std::int64_t field,
                               std::span<const Index> periods = {},
                               const RunContext& context = default_context());

}  // namespace ph
