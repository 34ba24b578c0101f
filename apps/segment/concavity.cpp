// SPDX-License-Identifier: MIT
#include "concavity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ph::segment {
namespace {

/// The sum of some vectors and of their squares.
struct Moments {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 1;  // the voxel itself, from where the others are seen: zero

  void add(const Eigen::Vector3d& d) {
    sum += d;
    squares += d * d.transpose();
    ++count;
  }
  Eigen::Vector3d direction_of_least_spread() const {
    const Eigen::Matrix3d scatter = squares - sum * sum.transpose() / count;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(scatter);
    return solver.eigenvectors().col(0);
  }
};

Eigen::Vector3d row(const Points& points, std::uint32_t i) { return points.row(i).transpose(); }

}  // namespace

Points surface_normals(const Points& centroids, const std::vector<VoxelPair>& pairs, double radius,
                       const Vec3& viewpoint) {
  std::vector<Moments> moments(static_cast<std::size_t>(centroids.rows()));
  for (const VoxelPair& p : pairs) {
    if (p.distance >= radius) continue;
    const Eigen::Vector3d d = row(centroids, p.v) - row(centroids, p.u);
    moments[p.u].add(d);
    moments[p.v].add(-d);
  }
  Points normals = Points::Constant(centroids.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector3d eye(viewpoint[0], viewpoint[1], viewpoint[2]);
  for (std::uint32_t v = 0; v < moments.size(); ++v) {
    if (moments[v].count < 3) continue;
    const Eigen::Vector3d n = moments[v].direction_of_least_spread();
    normals.row(v) = (n.dot(eye - row(centroids, v)) < 0 ? -n : n).transpose();
  }
  return normals;
}

double rise(const Points& centroids, const Points& normals, const VoxelPair& pair) {
  return (row(normals, pair.u) - row(normals, pair.v))
             .dot(row(centroids, pair.v) - row(centroids, pair.u)) /
         pair.distance;
}

std::vector<double> concavity(const Points& centroids, const Points& normals,
                              const std::vector<VoxelPair>& pairs) {
  struct Mean {
    double sum = 0;
    int count = 0;
    void add(double value) {
      sum += value;
      ++count;
    }
  };
  std::vector<Mean> means(static_cast<std::size_t>(centroids.rows()));
  for (const VoxelPair& p : pairs) {
    const double value = rise(centroids, normals, p);
    if (!std::isfinite(value)) continue;
    means[p.u].add(value);
    means[p.v].add(value);
  }
  std::vector<double> values(means.size());
  for (std::size_t v = 0; v < means.size(); ++v)
    if (means[v].count > 0) values[v] = std::max(0.0, means[v].sum / means[v].count);
  return values;
}

std::vector<double> smoothed(const std::vector<double>& values, const std::vector<VoxelPair>& pairs,
                             double radius) {
  std::vector<double> sums = values;
  std::vector<int> counts(values.size(), 1);
  for (const VoxelPair& p : pairs) {
    if (p.distance >= radius) continue;
    sums[p.u] += values[p.v];
    sums[p.v] += values[p.u];
    ++counts[p.u];
    ++counts[p.v];
  }
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= counts[v];
  return sums;
}

}  // namespace ph::segment
