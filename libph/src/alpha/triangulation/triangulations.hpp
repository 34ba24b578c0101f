// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/alpha/triangulation/triangulation.hpp"

// This header declares what the library computes with CGAL, without including CGAL.
namespace ph::alpha {

/// The triangulation in the plane of x and y. Precondition: there is at least one site.
Triangulation triangulate_plane(const Sites& sites, const RunContext& context);
/// The triangulation in space; for coplanar or collinear sites, the triangulation in their affine
/// hull.
Triangulation triangulate_space(const Sites& sites, const RunContext& context);

/// A point with its weight.
struct WeightedSite {
  Vector<double> point;
  double weight = 0;
};
/// True if a site lies strictly inside the smallest sphere through one to three others, which must
/// be affinely independent. With weights, true if the site has negative power with respect to the
/// smallest sphere orthogonal to the others. The result is exact.
bool is_inside(std::span<const WeightedSite> others, const WeightedSite& site);

/// True if three points lie on one line. The result is exact.
bool are_collinear(const std::array<Vector<double>, 3>& points);

/// The squared radius of the smallest sphere through two to four sites or, with weights, orthogonal
/// to them. The result is correct except for the last bit, even if the sites are almost in a plane
/// or on a line. It is at most the largest double.
double exact_squared_radius(std::span<const WeightedSite> sites);

}  // namespace ph::alpha
