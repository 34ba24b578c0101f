// SPDX-License-Identifier: MIT
#include "libsegment/src/surface/concavity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

/// A sum of vectors times their transposes. Such a matrix is symmetric.
struct Products {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(const Eigen::Vector3d& v, double weight = 1) {
    const Eigen::Vector3d w = weight * v;
    xx += w.x() * v.x();
    xy += w.x() * v.y();
    xz += w.x() * v.z();
    yy += w.y() * v.y();
    yz += w.y() * v.z();
    zz += w.z() * v.z();
  }
  Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d m;
    m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return m;
  }
};

/// The sums of some vectors and of their products.
struct Moments {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Products products;
  int count = 1;  // the voxel itself counts, and its vector is zero

  void add(const Eigen::Vector3d& v) {
    sum += v;
    products.add(v);
    ++count;
  }
  Eigen::Matrix3d scatter() const { return products.matrix() - sum * sum.transpose() / count; }
};

/// Scatter matrices of several voxels are processed side by side, so that the compiler can
/// vectorise over them.
constexpr std::size_t kLanes = 8;
using Lanes = std::array<double, kLanes>;

/// The smallest eigenvalues of positive semi-definite matrices of trace one. The characteristic
/// polynomial is concave to the left of its smallest root. Newton's method therefore climbs from
/// zero to that root and never passes it.
/// @param minors for each matrix, the sum of its principal minors of order two. @param determinants
/// the determinant of each matrix.
Lanes smallest_eigenvalues(const Lanes& minors, const Lanes& determinants) {
  constexpr int most_steps = 20;  // a double root takes many steps, and is then exact enough
  constexpr double least_step = 1e-15;
  Lanes x{};
  std::array<std::int64_t, kLanes> goes_on;  // as wide as the values themselves
  goes_on.fill(1);
  for (int step = 0; step < most_steps; ++step) {
    std::int64_t any = 0;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double value = ((x[k] - 1) * x[k] + minors[k]) * x[k] - determinants[k];
      const double slope = (3 * x[k] - 2) * x[k] + minors[k];
      const double next = x[k] - value / slope;
      goes_on[k] &=
          static_cast<std::int64_t>((value < 0) & (slope > 0) & !(next - x[k] < least_step));
      x[k] = goes_on[k] != 0 ? next : x[k];
      any |= goes_on[k];
    }
    if (any == 0) break;
  }
  return x;
}

/// The sum of the principal minors of order two.
double principal_minors(const Eigen::Matrix3d& a) {
  return a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1) + a(0, 0) * a(2, 2) - a(0, 2) * a(0, 2) +
         a(1, 1) * a(2, 2) - a(1, 2) * a(1, 2);
}

/// The unit vector along which vectors with this scatter spread least. If they are all on a line,
/// it is any unit vector orthogonal to the line.
/// @param a the scatter matrix, of trace one. @param eigenvalue its smallest eigenvalue.
Eigen::Vector3d direction_of_least_spread(const Eigen::Matrix3d& a, double eigenvalue) {
  const Eigen::Matrix3d rest = a - eigenvalue * Eigen::Matrix3d::Identity();
  // The direction is orthogonal to all rows of `rest`. The longest of the cross products of its
  // columns has the least rounding error.
  Eigen::Vector3d best = rest.col(0).cross(rest.col(1));
  for (const Eigen::Vector3d& other : {Eigen::Vector3d(rest.col(0).cross(rest.col(2))),
                                       Eigen::Vector3d(rest.col(1).cross(rest.col(2)))})
    if (other.squaredNorm() > best.squaredNorm()) best = other;
  constexpr double parallel = 1e-20;
  if (best.squaredNorm() > parallel) return best.normalized();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a);
  return solver.eigenvectors().col(0);
}

Eigen::Vector3d row(const Points& points, std::uint32_t i) {
  return as_matrix(points).row(i).transpose();
}

/// The mean of rise times direction times its transpose over the neighbours of a voxel. As a form
/// on the tangent plane, it says how much the surface rises in each direction.
class MeanRise {
 public:
  void add(double rise, const Eigen::Vector3d& direction) {
    sum_.add(direction, rise);
    ++count_;
  }
  /// The largest eigenvalue on the tangent plane, or 0 if it is negative. At the corner of a box on
  /// another box, the surface is a valley in one direction and a ridge in the other. The mean over
  /// all directions is then zero, but this number is the height of the valley.
  double largest(const Eigen::Vector3d& normal) const {
    if (count_ == 0) return 0;
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    const Eigen::Matrix3d sum = sum_.matrix();
    const double uu = u.dot(sum * u), uv = u.dot(sum * v), vv = v.dot(sum * v);
    // mutant: concavity-mean
    return std::max(0.0, ((uu + vv) / 2 + std::hypot((uu - vv) / 2, uv)) / count_);
  }

 private:
  Products sum_;
  int count_ = 0;
};

}  // namespace

Points surface_normals(const Points& centroids, std::span<const VoxelPair> pairs, double radius,
                       const Vec3& viewpoint) {
  std::vector<Moments> moments(static_cast<std::size_t>(centroids.rows()));
  for_each_within(pairs, radius, [&](const VoxelPair& p) {
    const Eigen::Vector3d d = row(centroids, p.v) - row(centroids, p.u);
    moments[p.u].add(d);
    moments[p.v].add(-d);
  });
  Points normals(centroids.rows(), 3);
  as_matrix(normals).setConstant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector3d eye(viewpoint[0], viewpoint[1], viewpoint[2]);
  std::array<Eigen::Matrix3d, kLanes> scatters;
  for (std::size_t first = 0; first < moments.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, moments.size() - first);
    Lanes minors{}, determinants{};
    for (std::size_t k = 0; k < count; ++k) {
      const Eigen::Matrix3d scatter = moments[first + k].scatter();
      scatters[k] = scatter / scatter.trace();
      minors[k] = principal_minors(scatters[k]);
      determinants[k] = scatters[k].determinant();
    }
    const Lanes eigenvalues = smallest_eigenvalues(minors, determinants);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t v = first + k;
      if (moments[v].count < 3) continue;
      const Eigen::Vector3d n = direction_of_least_spread(scatters[k], eigenvalues[k]);
      const auto at = static_cast<Index>(v);
      const Eigen::Vector3d to_eye = eye - as_matrix(centroids).row(at).transpose();
      as_matrix(normals).row(at) = (n.dot(to_eye) < 0 ? -n : n).transpose();
    }
  }
  return normals;
}

double rise(const Points& centroids, const Points& normals, const VoxelPair& pair) {
  return (row(normals, pair.u) - row(normals, pair.v))
             .dot(row(centroids, pair.v) - row(centroids, pair.u)) /
         pair.distance;
}

std::vector<double> concavity(const Points& centroids, const Points& normals,
                              std::span<const VoxelPair> pairs) {
  std::vector<MeanRise> means(static_cast<std::size_t>(centroids.rows()));
  for (const VoxelPair& p : pairs) {
    const double value = rise(centroids, normals, p);
    if (!std::isfinite(value)) continue;
    const Eigen::Vector3d direction = (row(centroids, p.v) - row(centroids, p.u)) / p.distance;
    means[p.u].add(value, direction);
    means[p.v].add(value, direction);
  }
  std::vector<double> values(means.size());
  for (std::size_t v = 0; v < means.size(); ++v)
    values[v] = means[v].largest(row(normals, static_cast<std::uint32_t>(v)));
  return values;
}

std::vector<double> smoothed(const std::vector<double>& values, std::span<const VoxelPair> pairs,
                             double radius) {
  std::vector<double> sums = values;
  std::vector<int> counts(values.size(), 1);
  for_each_within(pairs, radius, [&](const VoxelPair& p) {
    sums[p.u] += values[p.v];
    sums[p.v] += values[p.u];
    ++counts[p.u];
    ++counts[p.v];
  });
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= counts[v];
  return sums;
}

}  // namespace ph::segment
