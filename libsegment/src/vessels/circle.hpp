// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <bitset>
#include <span>
#include <vector>

namespace ph::segment {

/// A round shape, seen from above. Lengths are in metres.
struct Circle {
  Eigen::Vector2d centre;
  double radius = 0;  ///< arbitrary, or NaN, for points on a line
};

/// The number of sectors of ten degrees each.
inline constexpr std::size_t kSectors = 36;
using Sectors = std::bitset<kSectors>;

/// The depth, in voxels, of the upper end of an object, which may be a rim.
inline constexpr double kDepthOfRim = 2.4;

/// Fits a circle by least squares of |p|² = 2 c·p + (r² - |c|²) (I. Kåsa, A circle fitting
/// procedure and its error analysis, 1976). Each set of points has the same weight. Precondition:
/// no set is empty.
Circle fit_circle(std::initializer_list<const std::vector<Eigen::Vector2d>*> sets);

/// The root of the mean of the squares of the distances from a circle.
double deviation(const Circle& circle, const std::vector<Eigen::Vector2d>& points);

/// True if points deviate so little from a circle that they may be on a rim.
bool is_on(const Circle& circle, const std::vector<Eigen::Vector2d>& points, double voxel);

/// The sectors, seen from the centre, that contain points.
Sectors sectors_of(const Circle& circle, const std::vector<Eigen::Vector2d>& points);

}  // namespace ph::segment
