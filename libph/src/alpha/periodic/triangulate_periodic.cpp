// SPDX-License-Identifier: MIT
#include "alpha/periodic/triangulate_periodic.hpp"

#include <algorithm>
#include <cmath>

#include "alpha/periodic/quotient.hpp"
#include "ph/error.hpp"

namespace ph::alpha {
namespace {

std::array<double, 3> coordinates(const Vector<double>& p) { return {p.x, p.y, p.z}; }

/// A margin that is likely to do, were the sites anywhere with the same chance: the radius of the
/// largest empty sphere, and as much as cells of usual size beyond it.
double likely_margin(const Sites& sites, const Box& box) {
  std::array<double, 3> low = coordinates(sites.points[0]), high = low;
  for (const auto& p : sites.points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], coordinates(p)[axis]);
      high[axis] = std::max(high[axis], coordinates(p)[axis]);
    }
  const auto count = static_cast<double>(sites.size());
  double measure = 1, around = 0;
  int dim = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = box.is_closed(axis) ? box.period[axis] : high[axis] - low[axis];
    around = std::hypot(around, box.period[axis]);
    if (extent == 0) continue;
    measure *= extent;
    ++dim;
  }
  constexpr double few = 8;  // found by trial: less than one in many runs has to begin anew
  return std::min(around, std::pow(measure / count * (std::log(count) + few), 1.0 / dim));
}

/// The least margin with which a site has an image along each closed axis: without one the images
/// may have a smaller affine hull than all have.
double least_margin(const Sites& sites, const Box& box) {
  double least = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.is_closed(axis)) continue;
    double nearest = box.period[axis];
    for (const auto& p : sites.points) {
      const double x = coordinates(p)[axis];
      nearest = std::min({nearest, x, box.period[axis] - x});
    }
    least = std::max(least, nearest);
  }
  return least;
}

}  // namespace

PeriodicTriangulation triangulate_periodic(const Sites& sites, const Box& box,
                                           const RunContext& context) {
  constexpr double more = 1 + 1e-9;  // than rounding takes away
  const double most = 2 * more * box.size;
  double margin = std::max(likely_margin(sites, box), more * least_margin(sites, box));
  for (;;) {
    margin = std::min(margin, most);
    Images images = images_within(sites, box, margin, context);
    Triangulation triangulation = triangulate(images.places, context);
    if (take_quotient(triangulation, images, box, context))
      return {std::move(triangulation), std::move(images)};
    if (margin == most)
      throw Error(ErrorKind::internal, "alpha complex: cells around a periodic box do not fit");
    margin *= 2;
  }
}

}  // namespace ph::alpha
