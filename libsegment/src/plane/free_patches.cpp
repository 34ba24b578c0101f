// SPDX-License-Identifier: MIT
#include "plane/free_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ph::segment {
namespace {

/// The plane as squared paper, as far as there are points.
class SquaredPaper {
 public:
  SquaredPaper(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
               double side)
      : cloud_(cloud) {
    const Eigen::Vector3d n(plane.normal[0], plane.normal[1], plane.normal[2]);
    axes_[0] = n.unitOrthogonal() / side;
    axes_[1] = n.cross(axes_[0]);
    std::array<double, 2> high = {-kInfinity, -kInfinity};
    for (const Index i : points)
      for (std::size_t k = 0; k < 2; ++k) {
        low_[k] = std::min(low_[k], at(cloud.point(static_cast<std::size_t>(i)), k));
        high[k] = std::max(high[k], at(cloud.point(static_cast<std::size_t>(i)), k));
      }
    if (points.empty()) return;
    for (double& x : low_) x = std::floor(x);
    const double columns = std::floor(high[0] - low_[0]) + 1,
                 rows = std::floor(high[1] - low_[1]) + 1;
    if (!(columns * rows < kMost)) return;
    columns_ = static_cast<std::size_t>(columns);
    count_ = columns_ * static_cast<std::size_t>(rows);
    for (std::size_t k = 0; k < 2; ++k) {
      eye_[k] = axes_[k].dot(Eigen::Vector3d(cloud.viewpoint.data())) - low_[k];
    }
  }
  std::size_t count() const { return count_; }
  /// The square under a point.
  std::size_t of(Index i) const {
    const float* p = cloud_.point(static_cast<std::size_t>(i));
    return static_cast<std::size_t>(at(p, 1) - low_[1]) * columns_ +
           static_cast<std::size_t>(at(p, 0) - low_[0]);
  }
  /// The square of the distance of its centre from the foot of the viewpoint, in sides.
  double farness(std::size_t square) const {
    const double x = static_cast<double>(square % columns_) + 0.5 - eye_[0];
    const double y = static_cast<double>(square / columns_) + 0.5 - eye_[1];
    return x * x + y * y;
  }

 private:
  static constexpr double kMost = 1 << 20;  // a plane of 60 m by 60 m has fewer

  double at(const float* p, std::size_t k) const {
    return axes_[k][0] * p[0] + axes_[k][1] * p[1] + axes_[k][2] * p[2];
  }

  const CloudView& cloud_;
  std::array<Eigen::Vector3d, 2> axes_;
  std::array<double, 2> low_ = {kInfinity, kInfinity}, eye_{};
  std::size_t columns_ = 0, count_ = 0;
};

/// How many different points there are over a square, up to a number. Points that are there twice
/// tell nothing new.
class DifferentPoints {
 public:
  void add(const float* p, std::size_t most) {
    const std::array<float, 3> point = {p[0], p[1], p[2]};
    if (points_.size() < most && std::ranges::find(points_, point) == points_.end())
      points_.push_back(point);
  }
  std::size_t count() const { return points_.size(); }

 private:
  std::vector<std::array<float, 3>> points_;
};

/// Evenly by how far they are.
std::vector<std::size_t> some_of(std::vector<std::size_t> squares, const SquaredPaper& paper,
                                 std::size_t most) {
  std::ranges::sort(squares, {}, [&](std::size_t s) { return std::pair(paper.farness(s), s); });
  const std::size_t count = std::min(most, squares.size());
  for (std::size_t k = 0; k < count; ++k)
    squares[k] = squares[(2 * k + 1) * squares.size() / (2 * count)];
  squares.resize(count);
  return squares;
}

}  // namespace

std::vector<Index> free_patches(const CloudView& cloud, const std::vector<Index>& points,
                                const std::vector<Index>& beyond, const Plane& plane,
                                const PlaneMargin& margin, double side) {
  constexpr std::size_t most = 48;       // squares: what it takes is bounded
  constexpr std::size_t most_above = 3;  // points: an object has more, flying pixels fewer
  constexpr std::size_t fewest = 48;     // points of a square that tells
  constexpr double margins = 1.5;        // the noise is looked for, so it is not cut off
  const SquaredPaper paper(cloud, points, plane, side);
  if (paper.count() == 0) return {};
  std::vector<DifferentPoints> above(paper.count()), on(paper.count());
  for (const Index i : beyond)
    above[paper.of(i)].add(cloud.point(static_cast<std::size_t>(i)), most_above + 1);
  std::vector<std::pair<Index, std::size_t>> candidates;  // with their squares
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    if (std::abs(plane.signed_distance(p[0], p[1], p[2])) > margins * margin(cloud, p)) continue;
    const std::size_t square = paper.of(i);
    if (above[square].count() > most_above) continue;
    on[square].add(p, fewest);
    candidates.emplace_back(i, square);
  }
  std::vector<std::size_t> squares;
  for (std::size_t s = 0; s < on.size(); ++s)
    if (on[s].count() >= fewest) squares.push_back(s);
  std::vector<bool> chosen(paper.count());
  for (const std::size_t s : some_of(std::move(squares), paper, most)) chosen[s] = true;
  std::vector<Index> found;
  for (const auto& [i, square] : candidates)
    if (chosen[square]) found.push_back(i);
  return found;
}

}  // namespace ph::segment
