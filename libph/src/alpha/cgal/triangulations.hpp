// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "alpha/triangulation/triangulation.hpp"

// What CGAL does for us, without a name of CGAL's.
namespace ph::alpha {

/// The triangulation by x and y. Precondition: there is a site.
Triangulation triangulate_plane(const Sites& sites, const RunContext& context);
/// The triangulation by x, y and z; of coplanar and collinear sites that of their affine hull.
Triangulation triangulate_space(const Sites& sites, const RunContext& context);

/// A point with its weight.
struct WeightedSite {
  Vector<double> point;
  double weight = 0;
};
/// Whether a site lies strictly inside the smallest sphere through one to three others, which are
/// affinely independent. With weights: has a negative power to the smallest sphere that is
/// orthogonal to them. Exact.
bool is_inside(std::span<const WeightedSite> others, const WeightedSite& site);

/// Whether three points lie on one line. Exact.
bool are_collinear(const std::array<Vector<double>, 3>& points);

/// The squared radius of the smallest sphere through two to four sites, or orthogonal to them, of
/// weights. Correctly rounded but for the last bit, however flat they lie; at most
/// the largest double.
double exact_squared_radius(std::span<const WeightedSite> sites);

}  // namespace ph::alpha
