// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/stages.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "libsegment/src/plane/outline.hpp"
#include "libsegment/src/scene/close_boxes.hpp"
#include "libsegment/src/vessels/circle.hpp"
#include "libsegment/src/vessels/upper_end.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

constexpr std::size_t kFewestOfEach = 7;  // sectors

/// The sectors of the circle in which a rim has points. None if the rim is not on the circle.
Sectors arc(const Circle& circle, const UpperEnd& rim, double voxel) {
  return is_on(circle, rim.points, voxel) ? sectors_of(circle, rim.points) : Sectors();
}

bool share_a_rim(const UpperEnd& a, const UpperEnd& b, double voxel) {
  constexpr std::size_t all = kSectors / 2, of_both = 2;  // mutant: rim-half
  if (std::abs(a.top - b.top) > 2 * voxel) return false;
  const Circle circle = fit_circle({&a.points, &b.points});
  const Sectors p = arc(circle, a, voxel), q = arc(circle, b, voxel);
  return p.count() >= kFewestOfEach && q.count() >= kFewestOfEach && (p & q).count() <= of_both &&
         (p | q).count() >= all;
}

}  // namespace

void join_around_rims(const Points& centroids, double voxel, const Vec3& up, const Parts& parts,
                      const std::function<void(std::uint32_t, std::uint32_t)>& join,
                      const RunContext& context) {
  const Eigen::Matrix3d turn = upright(up);
  std::vector<std::vector<Eigen::Vector3d>> points(parts.count());
  for (std::size_t v = 0; v < parts.of.size(); ++v)
    if (parts.of[v] != Parts::kSmall)
      points[parts.of[v]].emplace_back(turn *
                                       as_matrix(centroids).row(static_cast<Index>(v)).transpose());
  std::vector<UpperEnd> rims;
  std::vector<PartBox<2>> boxes;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    rims.push_back(upper_end_of(points[p], kDepthOfRim * voxel));
    // With fewer points, too many sectors are empty.
    if (rims[p].points.size() < kFewestOfEach) continue;
    boxes.push_back({p, {}});
    for (const Eigen::Vector2d& point : rims[p].points) boxes.back().box.extend(point);
  }
  // An arc of this many sectors is longer than a third of the circle's diameter. The other rim on
  // the circle is therefore never farther away than this.
  constexpr double diagonals = 4;
  const auto reach = [](const PartBox<2>& b) { return diagonals * b.box.diagonal().norm(); };
  for_each_close_pair(boxes, reach, context, [&](std::uint32_t p, std::uint32_t q) {
    if (share_a_rim(rims[p], rims[q], voxel)) join(p, q);
  });
}

}  // namespace ph::segment
