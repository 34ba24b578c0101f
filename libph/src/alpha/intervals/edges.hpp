// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// The edges of a triangulation of dimension 3, numbered in the order of their smaller vertices.
struct NumberedEdges {
  explicit NumberedEdges(std::pmr::memory_resource* memory) : of_cell(memory), ends(memory) {}

  RawVector<std::array<std::uint32_t, 6>> of_cell;  ///< by cell, in the order of kEdgeEnds
  RawVector<std::array<std::uint32_t, 2>> ends;     ///< ascending
};

/// O(cells), but for vertices of many edges, where they are sorted. On threads.
NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites,
                           const RunContext& context);

}  // namespace ph::alpha
