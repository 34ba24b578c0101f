// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "alpha/sites/sites.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::alpha {

/// A Delaunay triangulation, regular if there are weights, of the affine hull of the sites: its
/// cells have dim + 1 vertices.
///
/// Facet k of cell t, the one opposite its vertex k, is called 4t + k. It has two such names, of
/// which the smaller one is usual, unless nothing but the outside lies across.
///
/// The vertices of a cell ascend, so a face has its vertices in the same order in each cell: signs
/// of boundaries are known from places.
///
/// In a periodic space it is a Delta-complex: a cell may have a vertex several times, and its other
/// faces once each; those with the same vertices may be different ones. Equal vertices are in an
/// order of their own (periodic/images.hpp), again the same in each cell.
struct Triangulation {
  explicit Triangulation(std::pmr::memory_resource* memory)
      : cells(memory), across(memory), is_reversed(memory) {}

  std::size_t size() const { return cells.size(); }

  int dim = -1;                                    ///< of the affine hull; -1: there is no site
  RawVector<std::array<std::uint32_t, 4>> cells;   ///< vertices, ascending; kNone beyond dim
  RawVector<std::array<std::uint32_t, 4>> across;  ///< by facet: the cell's other name; or kNone
  /// Whether a cell's vertices, as they ascend, are oriented against the others' (dim 2 and 3).
  RawVector<std::uint8_t> is_reversed;
};

/// @throws Error (resource, cancelled).
Triangulation triangulate(const Sites& sites, const RunContext& context);

/// Of weights: takes out the sites that belong to no cell.
/// @param hidden to it are added the points of the input that those are.
void remove_hidden(Sites& sites, Triangulation& triangulation,
                   std::pmr::vector<std::uint32_t>& hidden);

}  // namespace ph::alpha
