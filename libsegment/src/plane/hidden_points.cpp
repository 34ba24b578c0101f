// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/stages.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>

#include "libsegment/src/plane/squares.hpp"

namespace ph::segment {
namespace {

constexpr std::size_t kMostLookedAt = 20000;
// The side, in margins, of the square of the plane that a point represents.
constexpr double kCell = 4;

}  // namespace

PlaneSight sight_past(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                      const PlaneMargin& margin) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / kMostLookedAt);
  const auto& [vx, vy, vz] = cloud.viewpoint;
  const Eigen::Vector3d eye(vx, vy, vz);
  const double eye_height = plane.signed_distance(vx, vy, vz);
  const Squares squares(plane, kCell * margin.distance);
  std::vector<const float*> on;
  // For each point behind the plane, the place at which the line of sight to it meets the plane.
  std::vector<Eigen::Vector3d> through;
  std::size_t before = 0;
  for (std::size_t k = 0; k < points.size(); k += step) {
    const float* p = cloud.point(static_cast<std::size_t>(points[k]));
    const double height = plane.signed_distance(p[0], p[1], p[2]);
    const double limit = margin(cloud, p);
    if (std::abs(height) <= limit) {
      on.push_back(p);
    } else if (height > 0) {
      ++before;
    } else {
      const Eigen::Vector3d place(p[0], p[1], p[2]);
      through.push_back(eye + (place - eye) * (eye_height / (eye_height - height)));
    }
  }
  const auto off = static_cast<double>(before + through.size());
  PlaneSight sight;
  if (through.empty()) return sight;
  sight.behind = static_cast<double>(through.size()) / off;
  std::set<std::array<double, 2>> covered;
  for (const float* p : on) covered.insert(squares.of({p[0], p[1], p[2]}));
  const auto hidden = std::ranges::count_if(
      through, [&](const Eigen::Vector3d& p) { return covered.contains(squares.of(p)); });
  sight.hidden = static_cast<double>(hidden) / off;  // mutant: viewpoint-hidden
  return sight;
}

}  // namespace ph::segment
