// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "libsegment/src/plane/plane.hpp"

namespace ph::segment {

/// The margin of a plane, and of planes that are parallel to it, in a search. The noise of depth is
/// along the rays, which meet the plane at a slant.
class SlantedMargin {
 public:
  SlantedMargin(const PlaneMargin& margin, const Plane& plane, const Vec3& viewpoint)
      : noise_(margin.noise), normal_(plane.normal.data()), eye_(viewpoint.data()) {}
  double operator()(const Eigen::Vector3d& p) const {
    constexpr double thickness = 0.01;  // half of it, in metres
    const Eigen::Vector3d ray = p - eye_;
    return std::max(thickness, noise_ * ray.norm() * std::abs(normal_.dot(ray)));
  }

 private:
  double noise_;
  Eigen::Vector3d normal_, eye_;
};

/// Some of the points of a cloud, with an array for each coordinate, so that the compiler can
/// vectorise over them.
struct Sample {
  std::vector<double> x, y, z;
  std::vector<double> limits;  ///< the margin of a plane at each point, in metres
  std::size_t size() const { return x.size(); }
  Eigen::Vector3d operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set_limits(const SlantedMargin& margin) {
    for (std::size_t i = 0; i < size(); ++i) limits[i] = margin((*this)[i]);
  }
  void add(const Eigen::Vector3d& p, double limit) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
    limits.push_back(limit);
  }
};

/// Draws a random sample in random order that depends only on the set of points: the distinct
/// points with the smallest hashes, in the order of their hashes. If there are fewer than the size
/// of a sample, all points are taken. @param points indices into the cloud.
Sample draw_sample(const CloudView& cloud, const std::vector<Index>& points,
                   const PlaneMargin& margin);

/// The points of a sample that are farther from a plane than `margins` times their limit.
Sample points_off(const Plane& plane, double margins, const Sample& sample);

/// Mixes the bits of a word by the finaliser of splitmix64 (Steele, Lea & Flood 2014).
std::uint64_t mix(std::uint64_t x);

}  // namespace ph::segment
