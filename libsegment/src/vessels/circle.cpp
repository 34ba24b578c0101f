// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/circle.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ph::segment {

Circle fit_circle(std::initializer_list<const std::vector<Eigen::Vector2d>*> sets) {
  const Eigen::Vector2d origin = (*sets.begin())->front();
  Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto* points : sets) {
    const double weight = 1.0 / static_cast<double>(points->size());  // mutant: circle-weight
    for (const Eigen::Vector2d& point : *points) {
      const Eigen::Vector2d p = point - origin;
      const Eigen::Vector3d row(p.x(), p.y(), 1);
      left += weight * row * row.transpose();
      right += weight * p.squaredNorm() * row;
    }
  }
  const Eigen::Vector3d solution = left.ldlt().solve(right);
  const Eigen::Vector2d centre = solution.head<2>() / 2;
  return {origin + centre, std::sqrt(solution.z() + centre.squaredNorm())};
}

double deviation(const Circle& circle, const std::vector<Eigen::Vector2d>& points) {
  double squares = 0;
  for (const Eigen::Vector2d& point : points)
    squares += std::pow((point - circle.centre).norm() - circle.radius, 2);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

bool is_on(const Circle& circle, const std::vector<Eigen::Vector2d>& points, double voxel) {
  constexpr double of_voxel = 1.6, of_radius = 0.1;
  // The comparison is false for a circle through points on a line, which is NaN.
  return deviation(circle, points) <= std::min(of_voxel * voxel, of_radius * circle.radius);
}

Sectors sectors_of(const Circle& circle, const std::vector<Eigen::Vector2d>& points) {
  Sectors sectors;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d p = point - circle.centre;
    const double turn = std::atan2(p.y(), p.x()) / (2 * std::numbers::pi) + 0.5;
    sectors.set(static_cast<std::size_t>(turn * kSectors) % kSectors);
  }
  return sectors;
}

}  // namespace ph::segment
