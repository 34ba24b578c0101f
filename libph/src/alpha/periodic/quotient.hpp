// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/alpha/periodic/images.hpp"
#include "libph/src/alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// Turns the triangulation of sites and images into a triangulation of the periodic space. It keeps
/// one cell of each class of translates, and glues two cells together if translates of them are
/// neighbours. The vertices of the result are sites; a cell may contain the same site several
/// times, and `images.of_cell` receives the places of its vertices.
///
/// Returns true if the result is the Delaunay triangulation of the periodic space, and false if
/// there were too few images around the box. The result is this triangulation under the following
/// conditions, all of which are checked or always true:
/// - On either side of a facet there is a cell that is a translate of a kept cell, and the two
///   cells name each other as neighbours. The only exceptions are facets whose plane contains the
///   directions of all closed axes, with all images on one side of the plane. Unrolled, the cells
///   therefore cover the space the same number of times everywhere.
/// - At one of the sites, the kept cells are the cells around it in the unrolled triangulation,
///   which cover its surroundings once.
/// - Two cells that share a facet are neighbours in a Delaunay triangulation. A triangulation that
///   is locally Delaunay is Delaunay (Delaunay 1934).
/// - Each site has a cell, except sites that are already hidden in the box.
/// @param triangulation the triangulation of `images.places`; replaced if true is returned.
bool take_quotient(Triangulation& triangulation, Images& images, const Box& box,
                   const RunContext& context);

/// A triangulation of a periodic space with any number of sites.
struct PeriodicTriangulation {
  Triangulation triangulation;  ///< vertices are sites, which may recur in a cell
  Images images;                ///< including the frames of the cells
};

/// Triangulates a periodic space, in O(n log n) for evenly spread sites. Precondition: there is at
/// least one site and one closed axis.
/// @param box in the units of the sites.
/// @throws Error (resource, cancelled).
PeriodicTriangulation triangulate_periodic(const Sites& sites, const Box& box,
                                           const RunContext& context);

}  // namespace ph::alpha
