// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/alpha/sites/sites.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::alpha {

/// A Delaunay triangulation (regular if there are weights) of the affine hull of the sites: its
/// cells have dim + 1 vertices.
///
/// Facet k of cell t, opposite the cell's vertex k, has the name 4t + k. A facet between two cells
/// has two such names, of which the smaller one is called usual.
///
/// The vertices of a cell ascend; a face therefore has its vertices in the same order in each cell,
/// and positions determine the signs of boundaries.
///
/// In a periodic space it is a Delta-complex: a cell may have a vertex several times, but each
/// other face only once; faces with the same vertices may be different. Equal vertices have an
/// order of their own (periodic/images.hpp), which again is the same in each cell.
struct Triangulation {
  explicit Triangulation(std::pmr::memory_resource* memory)
      : cells(memory), across(memory), is_reversed(memory) {}

  std::size_t size() const { return cells.size(); }

  int dim = -1;                                   ///< of the affine hull; -1 if there is no site
  RawVector<std::array<std::uint32_t, 4>> cells;  ///< vertices, ascending, then kNone
  /// By facet: its name in the other cell, or kNone.
  RawVector<std::array<std::uint32_t, 4>> across;
  /// True if the ascending vertices of a cell are oriented against those of the other cells (dim 2
  /// and 3).
  RawVector<std::uint8_t> is_reversed;
};

/// @throws Error (resource, cancelled).
Triangulation triangulate(const Sites& sites, const RunContext& context);

/// With weights: removes the sites that belong to no cell.
/// @param hidden receives the corresponding points of the input.
void remove_hidden(Sites& sites, Triangulation& triangulation,
                   std::pmr::vector<std::uint32_t>& hidden);

}  // namespace ph::alpha
