// SPDX-License-Identifier: MIT
#include "surfaces/lower_support.hpp"

#include <algorithm>

namespace ph::segment {
namespace {

constexpr double kLeastDepth = 0.04;  // metres below the upper one: what is nearer is its edge
constexpr double kLeastPart = 0.02;   // of the points in range
constexpr double kLeastCosine = 0.98;
constexpr double kThickness = 0.02;  // half of it, metres, while the plane is looked for

bool nothing_is_below(const Plane& plane, const CloudView& cloud) {
  constexpr double margin = 0.05;      // metres
  constexpr double most_below = 0.01;  // of all points
  std::size_t all = 0, below = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float* p = cloud.point(i);
    const double height = plane.signed_distance(p[0], p[1], p[2]);
    all += height > -kInfinity ? 1U : 0U;  // not of a hole
    below += height < -margin ? 1U : 0U;
  }
  return static_cast<double>(below) <= most_below * static_cast<double>(all);
}

}  // namespace

std::optional<LowerSupport> find_lower_support(const CloudView& cloud,
                                               const std::vector<Index>& points, const Plane& upper,
                                               double least_margin) {
  constexpr double deviations = 4;  // as of the upper one
  LowerSupport lower;
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    if (upper.signed_distance(p[0], p[1], p[2]) < -kLeastDepth) lower.points.push_back(i);
  }
  if (static_cast<double>(lower.points.size()) < kLeastPart * static_cast<double>(points.size()))
    return std::nullopt;
  const PlaneSearch search = find_plane(cloud, lower.points, kThickness);
  if (!search.plane) return std::nullopt;
  lower.plane = *search.plane;
  double cosine = 0;
  for (std::size_t k = 0; k < 3; ++k) cosine += upper.normal[k] * lower.plane.normal[k];
  if (cosine < kLeastCosine || !nothing_is_below(lower.plane, cloud)) return std::nullopt;
  lower.margin = {kThickness, std::max(least_margin, deviations * search.noise)};
  return lower;
}

}  // namespace ph::segment
