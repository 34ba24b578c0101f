// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/stages.hpp"

#include <algorithm>

namespace ph::segment {
namespace {

// In metres; a nearer surface is the edge of the upper support.
constexpr double kLeastDepth = 0.04;
constexpr double kLeastPart = 0.02;  // a share of the points in range
constexpr double kLeastCosine = 0.98;
// Half the thickness, in metres, during the search for the plane.
constexpr double kThickness = 0.02;
constexpr PlaneMargin kBelow{0.05};  // deeper points are below the plane
// A share of all points, which may be reflections or flying pixels.
constexpr double kMostBelow = 0.01;

}  // namespace

std::optional<LowerSupport> find_lower_support(const CloudView& cloud,
                                               const std::vector<Index>& points, const Plane& upper,
                                               double least_margin) {
  constexpr double deviations = 4;  // the same number as for the upper support
  LowerSupport lower;
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    if (upper.signed_distance(p[0], p[1], p[2]) < -kLeastDepth) lower.points.push_back(i);
  }
  if (static_cast<double>(lower.points.size()) < kLeastPart * static_cast<double>(points.size()))
    return std::nullopt;
  const PlaneSearch search = find_plane(cloud, lower.points, {kThickness, least_margin});
  if (!search.plane) return std::nullopt;
  lower.plane = *search.plane;
  if (cosine_between(upper, lower.plane) < kLeastCosine ||
      share_behind(cloud, lower.plane, kBelow) > kMostBelow)
    return std::nullopt;
  lower.margin = {kThickness, std::max(least_margin, deviations * search.noise)};
  return lower;
}

}  // namespace ph::segment
