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

/// A Delaunay triangulation of the sites (with weights, a regular triangulation) in their affine
/// hull, which has dimension `dim`. Cells have dim + 1 vertices.
///
/// Facet k of cell t, opposite the cell's vertex k, has the name 4t + k. A facet between two cells
/// has two such names; the smaller one is its *usual name*.
///
/// The vertices of a cell ascend. A face therefore has its vertices in the same order in each cell,
/// and the positions of vertices determine the signs in boundaries.
///
/// In a periodic space, the triangulation is a Delta-complex: a cell may have a vertex several
/// times, but each other face only once, and different faces may have the same vertices. Equal
/// vertices are sorted by their places (periodic/images.hpp); this order is the same in each cell
/// as well.
struct Triangulation {
  explicit Triangulation(std::pmr::memory_resource* memory)
      : cells(memory), across(memory), is_reversed(memory) {}

  std::size_t size() const { return cells.size(); }

  int dim = -1;  ///< dimension of the affine hull; -1 if there is no site
  RawVector<std::array<std::uint32_t, 4>> cells;  ///< vertices, ascending, then kNone
  /// For each facet: its name in the cell on the other side, or kNone if there is no such cell.
  RawVector<std::array<std::uint32_t, 4>> across;
  /// True if the ascending vertices of a cell are oriented against those of the other cells (dim 2
  /// and 3).
  RawVector<std::uint8_t> is_reversed;
};

/// Triangulates the sites. @throws Error (resource, cancelled).
Triangulation triangulate(const Sites& sites, const RunContext& context);

/// Removes the sites that belong to no cell; only for sites with weights.
/// @param hidden receives the corresponding points of the input.
void remove_hidden(Sites& sites, Triangulation& triangulation,
                   std::pmr::vector<std::uint32_t>& hidden);

}  // namespace ph::alpha
