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

/// A Delaunay triangulation of the sites in their affine hull, which has dimension `dim`. If the
/// sites have weights, it is a regular triangulation. Cells have dim + 1 vertices.
///
/// Facet k of cell t, opposite the cell's vertex k, has the name 4t + k. A facet between two cells
/// has two such names; the smaller one is its *usual name*.
///
/// The vertices of a cell are in ascending order. A face therefore has its vertices in the same
/// order in each cell, and the positions of vertices determine the signs in boundaries.
///
/// In a periodic space, the triangulation is a Delta-complex. A cell may have the same vertex
/// several times, but each of its other faces only once. Different faces may have the same
/// vertices. Equal vertices are sorted by their places (periodic/images.hpp), and their order is
/// also the same in each cell.
struct Triangulation {
  explicit Triangulation(std::pmr::memory_resource* memory)
      : cells(memory), across(memory), is_reversed(memory) {}

  std::size_t size() const { return cells.size(); }

  int dim = -1;  ///< dimension of the affine hull; -1 if there is no site
  RawVector<std::array<std::uint32_t, 4>> cells;  ///< vertices in ascending order, then kNone
  /// For each facet, its name in the cell on the other side, or kNone if there is no such cell.
  RawVector<std::array<std::uint32_t, 4>> across;
  /// In dimensions 2 and 3, the cells have a common orientation. For each cell, true if the
  /// ascending order of its vertices has the opposite orientation.
  RawVector<std::uint8_t> is_reversed;
};

/// Triangulates the sites. @throws Error (resource, cancelled).
Triangulation triangulate(const Sites& sites, const RunContext& context);

/// Removes the sites that belong to no cell. Such sites exist only if sites have weights.
/// @param hidden receives the corresponding points of the input.
void remove_hidden(Sites& sites, Triangulation& triangulation,
                   std::pmr::vector<std::uint32_t>& hidden);

}  // namespace ph::alpha
