// SPDX-License-Identifier: MIT
#pragma once
#include "alpha/periodic/images.hpp"
#include "alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// Makes of the triangulation of sites and images that of the periodic space: one of each class of
/// cells that are translates of each other, glued where their translates are neighbours. Its
/// vertices are sites, which a cell may have several times; `images.of_cell` says where they are.
///
/// Nothing is taken on trust. What is found is the Delaunay triangulation of the periodic space, or
/// else there were too few images around the box, and false is returned:
/// - Each facet has a cell on either side that is the translate of one of those kept, and the two
///   name each other. Or its plane has the directions of all closed axes and all images on one
///   side. So the cells, unrolled, cover the space the same number of times everywhere.
/// - The cells at one of the sites are those around it in the triangulation, which cover it once.
/// - Neighbours are so in a Delaunay triangulation. What is one locally is one (Delaunay 1934).
/// - Each site has a cell, but those that are hidden in the box already.
/// @param triangulation of `images.places`; replaced if true is returned.
bool take_quotient(Triangulation& triangulation, Images& images, const Box& box,
                   const RunContext& context);

}  // namespace ph::alpha
