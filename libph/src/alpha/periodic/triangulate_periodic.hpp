// SPDX-License-Identifier: MIT
#pragma once
#include "alpha/periodic/images.hpp"
#include "alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

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
