// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/planar.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

Eigen::Vector3d row(const Points& points, Index i) { return as_matrix(points).row(i).transpose(); }

struct Candidate {
  Eigen::Vector3d normal;
  double offset = 0;
  double distance(const Eigen::Vector3d& p) const { return normal.dot(p) + offset; }
};

bool is_on(const Candidate& plane, const Eigen::Vector3d& p, const Eigen::Vector3d& eye) {
  return std::abs(plane.distance(p)) < flatness((p - eye).squaredNorm());
}

/// The least-squares plane of the voxels on a plane. Empty if these voxels are on a line.
std::optional<Candidate> refit(const Candidate& plane, const Points& centroids,
                               std::span<const Index> voxels, const Eigen::Vector3d& eye) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> on;
  for (const Index v : voxels)
    if (const Eigen::Vector3d p = row(centroids, v); is_on(plane, p, eye)) on.push_back(p);
  if (on.size() < 3) return std::nullopt;
  for (const auto& p : on) mean += p;
  mean /= static_cast<double>(on.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : on) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  constexpr double least_spread = 1e-9;  // a share of the largest spread
  if (!(solver.eigenvalues()[1] > least_spread * solver.eigenvalues()[2])) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return Candidate{normal, -normal.dot(mean)};
}

}  // namespace

double flatness(double square_of_range) {
  constexpr double at_one_metre = 0.009;
  return at_one_metre * std::max(1.0, square_of_range);
}

std::optional<Plane> plane_through(const Points& centroids, const Points& normals,
                                   std::span<const Index> voxels, const Vec3& viewpoint) {
  const Eigen::Vector3d eye(viewpoint.data());
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Index v : voxels)
    if (const Eigen::Vector3d n = row(normals, v); n.allFinite()) normal += n;
  if (!(normal.norm() > 0)) return std::nullopt;
  normal.normalize();
  std::vector<double> offsets;
  for (const Index v : voxels) offsets.push_back(-normal.dot(row(centroids, v)));
  const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
  std::ranges::nth_element(offsets, middle);
  const auto fitted = refit({normal, *middle}, centroids, voxels, eye);
  if (!fitted) return std::nullopt;
  Candidate plane = *fitted;
  if (plane.distance(eye) < 0) plane = {-plane.normal, -plane.offset};
  Plane found{{plane.normal.x(), plane.normal.y(), plane.normal.z()}, plane.offset, 0};
  found.share = share_on(found, centroids, voxels, viewpoint);
  return found;
}

Index count_on(const Plane& plane, const Points& centroids, std::span<const Index> voxels,
               const Vec3& viewpoint) {
  const Candidate candidate{Eigen::Vector3d(plane.normal.data()), plane.offset};
  const Eigen::Vector3d eye(viewpoint.data());
  return std::ranges::count_if(voxels,
                               [&](Index v) { return is_on(candidate, row(centroids, v), eye); });
}

double share_on(const Plane& plane, const Points& centroids, std::span<const Index> voxels,
                const Vec3& viewpoint) {
  return static_cast<double>(count_on(plane, centroids, voxels, viewpoint)) /
         static_cast<double>(voxels.size());
}

}  // namespace ph::segment
