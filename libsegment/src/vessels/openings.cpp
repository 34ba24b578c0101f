// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/stages.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "libsegment/src/plane/outline.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/vessels/circle.hpp"
#include "libsegment/src/vessels/upper_end.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

struct Opening {
  Circle circle;
  double height;        ///< height above the plane
  std::uint32_t voxel;  ///< the voxel that receives its points
};

/// Erases the points that are far from the circle through all points, such as those of a handle.
void erase_outliers(std::vector<Eigen::Vector2d>& points, double voxel) {
  const Circle circle = fit_circle({&points});
  std::vector<double> distances;
  for (const Eigen::Vector2d& p : points)
    distances.push_back(std::abs((p - circle.centre).norm() - circle.radius));
  std::vector<double> sorted = distances;
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, median);
  const double most = std::max(2 * *median, voxel);  // mutant: opening-handles
  std::size_t next = 0;
  std::erase_if(points, [&](const Eigen::Vector2d&) { return distances[next++] > most; });
}

/// The opening of an object. Empty if the upper end of the object is not a round rim.
/// @param object the voxels of the object, with x and y along the plane and z above it. @param
/// numbers the numbers of these voxels in the grid.
std::optional<Opening> opening_of(const std::vector<Eigen::Vector3d>& object,
                                  const std::vector<std::uint32_t>& numbers, double voxel) {
  // mutant: opening-sectors
  constexpr std::size_t fewest_sectors = 20;  // out of 36 sectors
  auto [top, rim] = upper_end_of(object, kDepthOfRim * voxel);
  for (int times = 0; times < 2; ++times) erase_outliers(rim, voxel);
  const Circle circle = fit_circle({&rim});
  if (!is_on(circle, rim, voxel) || sectors_of(circle, rim).count() < fewest_sectors)
    return std::nullopt;
  std::size_t lowest = 0;
  const auto cost = [&](std::size_t k) {
    return object[k].z() + (object[k].head<2>() - circle.centre).norm();
  };
  for (std::size_t k = 1; k < object.size(); ++k)
    if (cost(k) < cost(lowest)) lowest = k;  // mutant: opening-lowest
  return Opening{circle, top, numbers[lowest]};
}

}  // namespace

bool may_be_in_opening(const Plane& plane, const Vec3& point, const Vec3& voxel) {
  // mutant: opening-bottom
  constexpr double below = 0.05, reach = 0.5;  // in metres
  const double height = plane.signed_distance(point[0], point[1], point[2]);
  return height >= -below && height <= plane.signed_distance(voxel[0], voxel[1], voxel[2]) &&
         std::hypot(point[0] - voxel[0], point[1] - voxel[1], point[2] - voxel[2]) <= reach;
}

void assign_points_in_openings(const CloudView& cloud, const std::vector<Index>& in_range,
                               const Plane& plane, double voxel,
                               const std::vector<Index>& object_of, Index min_size,
                               std::vector<Index>& points, VoxelGrid& grid) {
  const Eigen::Matrix3d turn = upright(plane.normal);
  const auto above = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return turn * p + Eigen::Vector3d(0, 0, plane.offset);
  };
  const Parts objects = number_parts(object_of, min_size);
  std::vector<std::vector<Eigen::Vector3d>> places(objects.count());
  std::vector<std::vector<std::uint32_t>> numbers(objects.count());
  for (std::uint32_t v = 0; v < objects.of.size(); ++v) {
    if (objects.of[v] == Parts::kSmall) continue;
    places[objects.of[v]].push_back(above(as_matrix(grid.centroids).row(v).transpose()));
    numbers[objects.of[v]].push_back(v);
  }
  const Eigen::Vector3d eye = above(Eigen::Vector3d(cloud.viewpoint.data()));
  std::vector<Opening> openings;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto opening = opening_of(places[k], numbers[k], voxel);
    if (opening && opening->height < eye.z()) openings.push_back(*opening);
  }
  if (openings.empty()) return;
  const auto place_of = [&](std::uint32_t v) -> Vec3 {
    const auto row = grid.centroids.row(v);
    return {row[0], row[1], row[2]};
  };
  std::vector<bool> has_voxel(cloud.size());
  for (const Index i : points) has_voxel[static_cast<std::size_t>(i)] = true;
  for (const Index i : in_range) {
    const float* q = cloud.point(static_cast<std::size_t>(i));
    if (has_voxel[static_cast<std::size_t>(i)]) continue;
    const Eigen::Vector3d p = above({q[0], q[1], q[2]});
    for (const Opening& opening : openings) {
      if (p.z() >= opening.height) continue;
      // The distance between the axis of the opening and the ray through the point, at a given
      // height.
      const auto from_axis = [&](double height) {
        const double t = (eye.z() - height) / (eye.z() - p.z());
        return ((eye + t * (p - eye)).head<2>() - opening.circle.centre).norm();
      };
      // This checks that the ray enters through the opening and does not leave through a gap in the
      // wall.
      // mutant: opening-gaps
      if (from_axis(opening.height) >= opening.circle.radius ||
          from_axis(std::max(p.z(), 0.0)) >= opening.circle.radius ||
          !may_be_in_opening(plane, {q[0], q[1], q[2]}, place_of(opening.voxel)))
        continue;
      points.push_back(i);
      grid.voxel_of.push_back(opening.voxel);
      break;
    }
  }
}

}  // namespace ph::segment
