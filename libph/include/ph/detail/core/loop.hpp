// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/core/names.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// A closed walk along edges, given by its vertices: it returns from the last vertex to the first,
/// which is not repeated. The walk stands for a chain. In this chain, an edge walked from its first
/// vertex to its second (in a grid, along its axis) has the coefficient `coefficient`, and an edge
/// walked the other way has the negated coefficient.
struct Loop {
  /// The numbers of the vertices, one after another: one number each (CellKind::vertices), or the
  /// doubled coordinates (CellKind::grid).
  std::vector<Index> numbers;
  std::int64_t coefficient = 1;
  /// The sum of the values of its edges, if values are lengths.
  std::optional<double> length = std::nullopt;
  friend bool operator==(const Loop&, const Loop&) = default;
};

/// The loops to compute for the cycles of H1: shortened loops, loops as they are found, or none.
enum class LoopChoice { tight, plain, none };

template <>
inline constexpr std::array names_of<LoopChoice>{
    Named{LoopChoice::tight, "tight"},
    Named{LoopChoice::plain, "plain"},
    Named{LoopChoice::none, "none"},
};

/// The guarantee about the length of loops.
enum class Tightness {
  none,      ///< no guarantee
  locally,   ///< no step across one or two triangles shortens a loop
  shortest,  ///< no closed walk that could replace a loop is shorter, see ph/loops.hpp
};

template <>
inline constexpr std::array names_of<Tightness>{
    Named{Tightness::none, "no"},
    Named{Tightness::locally, "locally"},
    Named{Tightness::shortest, "shortest"},
};

/// The loops of a bar of H1: multiplied by their coefficients, they sum to a cycle that represents
/// the bar.
struct BarLoops {
  std::vector<Loop> loops;
  Tightness tightness = Tightness::none;
};

/// Bytes held by loops.
std::size_t bytes_of(std::span<const BarLoops> loops);

/// Splits a cycle of edges into closed walks. Multiplied by their coefficients, the walks sum to
/// the cycle, edge by edge; no walk passes a vertex twice. Over Z/2 no edge is in two walks. The
/// result depends on the chain alone: a walk begins with its smallest vertex and continues to the
/// smaller of its two neighbours (Z/2), or in the direction of a positive coefficient (Z/p); walks
/// are ordered by descending number of steps, then by vertices. O(edges) over Z/2; over Z/p, each
/// edge may add a walk of O(edges) steps.
///
/// On a periodic axis of one or two voxels, the vertices do not identify an edge. With one voxel, a
/// walk has one vertex and one step; with two voxels, two edges join the same vertices.
/// @param field the characteristic of the coefficients.
/// @param periods for grid cells: by axis, the number of doubled coordinates if the axis is
///        periodic, otherwise 0; empty if no axis is periodic.
/// @throws Error (usage) if the cells are not edges (this includes rows of a boundary matrix), or
///         if the boundary of the chain is not zero; Error (resource, cancelled).
std::vector<Loop> closed_walks(const InputChain& cycle, std::int64_t field,
                               std::span<const Index> periods = {},
                               const RunContext& context = default_context());

}  // namespace ph
