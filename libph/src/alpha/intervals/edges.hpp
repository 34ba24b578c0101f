// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "alpha/periodic/images.hpp"
#include "alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// The edges of a triangulation of dimension 3, numbered in the order of their smaller vertices.
struct NumberedEdges {
  explicit NumberedEdges(std::pmr::memory_resource* memory) : of_cell(memory), ends(memory) {}

  RawVector<std::array<std::uint32_t, 6>> of_cell;  ///< by cell, in the order of kEdgeEnds
  RawVector<std::array<std::uint32_t, 2>> ends;     ///< ascending; the same twice: a loop
};

/// O(cells). On threads.
/// @param images of a periodic space, or null. Gets the frames of the edges.
NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites, Images* images,
                           const RunContext& context);

}  // namespace ph::alpha
