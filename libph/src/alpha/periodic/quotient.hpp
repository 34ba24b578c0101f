// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/alpha/periodic/images.hpp"
#include "libph/src/alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// Turns the triangulation of sites and images into a triangulation of the periodic space: one cell
/// of each class of translates, glued where translates are neighbours. Its vertices are sites; a
/// cell may have a site several times, and `images.of_cell` has their places.
///
/// Every condition is checked. True means that the result is the Delaunay triangulation of the
/// periodic space; false means that there were too few images around the box. The conditions are:
/// - Each facet has on either side a cell that is a translate of a kept cell, and the two cells
///   name each other. Otherwise the plane of the facet contains the directions of all closed axes,
///   and all images lie on one side of it. Unrolled, the cells therefore cover the space the same
///   number of times everywhere.
/// - The cells at one of the sites are the cells around it in the triangulation, which cover it
///   once.
/// - Neighbours are neighbours in a Delaunay triangulation. A triangulation that is Delaunay
///   locally is Delaunay (Delaunay 1934).
/// - Each site has a cell, except sites that are already hidden in the box.
/// @param triangulation the triangulation of `images.places`; replaced if true is returned.
bool take_quotient(Triangulation& triangulation, Images& images, const Box& box,
                   const RunContext& context);

/// A triangulation of a periodic space, of any number of sites.
struct PeriodicTriangulation {
  Triangulation triangulation;  ///< vertices are sites; a cell may have a site several times
  Images images;                ///< with the frames of cells
};

/// O(n log n) for evenly spread sites. Precondition: there is at least one site and one closed
/// axis.
/// @param box in the units of the sites.
/// @throws Error (resource, cancelled).
PeriodicTriangulation triangulate_periodic(const Sites& sites, const Box& box,
                                           const RunContext& context);

}  // namespace ph::alpha
