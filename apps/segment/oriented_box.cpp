// SPDX-License-Identifier: MIT
#include "oriented_box.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ph::segment {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 array(const Vector3d& v) { return {v[0], v[1], v[2]}; }

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Takes out what cannot be on the hull: points inside the octagon of those that are farthest in
/// eight directions (Akl & Toussaint 1978). What is left is few, whatever the shape of an object.
void keep_outer(std::vector<Vector2d>& points) {
  constexpr std::size_t corners = 8, few = 64;
  if (points.size() < few) return;
  // Along x, x + y, y, y - x, and against them.
  std::array<double, corners / 2> most, least;
  most.fill(-kInfinity);
  least.fill(kInfinity);
  std::array<Vector2d, corners> farthest;
  for (const Vector2d& p : points) {
    const std::array<double, corners / 2> along{p[0], p[0] + p[1], p[1], p[1] - p[0]};
    for (std::size_t k = 0; k < along.size(); ++k) {
      if (along[k] > most[k]) {
        most[k] = along[k];
        farthest[k] = p;
      }
      if (along[k] < least[k]) {
        least[k] = along[k];
        farthest[k + along.size()] = p;
      }
    }
  }
  // On the inner side of an edge, by more than rounding may be wrong.
  double rounding = 0;
  for (const Vector2d& p : farthest) rounding = std::max(rounding, 1e-12 * p.norm());
  std::array<Vector2d, corners> inwards;
  std::array<double, corners> beyond;
  for (std::size_t k = 0; k < corners; ++k) {
    const Vector2d &from = farthest[k], edge = farthest[(k + 1) % corners] - from;
    inwards[k] = {-edge[1], edge[0]};
    beyond[k] = edge.isZero(0) ? -kInfinity : inwards[k].dot(from) + rounding * edge.norm();
  }
  std::erase_if(points, [&](const Vector2d& p) {
    bool is_inside = true;
    for (std::size_t k = 0; k < corners; ++k) is_inside &= inwards[k].dot(p) > beyond[k];
    return is_inside;
  });
}

/// The corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  keep_outer(points);
  const auto comes_before = [](const Vector2d& a, const Vector2d& b) {
    return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
  };
  std::ranges::sort(points, comes_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vector2d> hull;
  const auto add = [&](const Vector2d& p, std::size_t least) {
    while (hull.size() > least &&
           !(cross(hull.back() - hull[hull.size() - 2], p - hull.back()) > 0))
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vector2d& p : points) add(p, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.pop_back();  // the first one again
  return hull;
}

/// A direction along which the smallest rectangle around a convex polygon lies.
Vector2d direction_of_smallest_rectangle(const std::vector<Vector2d>& hull) {
  const std::size_t n = hull.size();
  if (n == 1) return {1, 0};
  if (n == 2) return (hull[1] - hull[0]).normalized();
  Vector2d best{1, 0};
  double least = kInfinity;
  std::size_t right = 0, top = 0, left = 0;  // corners that touch the other sides
  const auto turn = [&](std::size_t& corner, const Vector2d& direction) {
    for (std::size_t steps = 0; steps < n; ++steps) {
      const std::size_t next = (corner + 1) % n;
      if (!(direction.dot(hull[next]) > direction.dot(hull[corner]))) return;
      corner = next;
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d along = (hull[(i + 1) % n] - hull[i]).normalized();
    const Vector2d inwards(-along[1], along[0]);
    if (i == 0) right = 1;
    turn(right, along);
    if (i == 0) top = right;
    turn(top, inwards);
    if (i == 0) left = top;
    turn(left, -along);
    const double area = along.dot(hull[right] - hull[left]) * inwards.dot(hull[top] - hull[i]);
    if (!(area < least)) continue;
    least = area;
    best = along;
  }
  return best;
}

/// Of a direction and its opposite the one whose largest coordinate is positive.
Vector3d pointing_forward(const Vector3d& direction) {
  Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? Vector3d(-direction) : direction;
}

}  // namespace

OrientedBox box_along(std::span<const float> xyz, const std::array<Vec3, 3>& axes) {
  Eigen::Matrix3d rows;
  for (std::size_t k = 0; k < 3; ++k) rows.row(static_cast<Index>(k)) = vector(axes[k]).transpose();
  Vector3d low = Vector3d::Constant(kInfinity), high = -low;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    const Vector3d p = rows * Vector3d(xyz[i], xyz[i + 1], xyz[i + 2]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {array(rows.transpose() * (low + high) / 2), axes, array(high - low)};
}

OrientedBox box_on_plane(std::span<const float> xyz, const Vec3& up) {
  const Vector3d normal = vector(up);
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vector2d> footprint(xyz.size() / 3);
  double low = kInfinity, high = -kInfinity;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vector3d p(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    footprint[i] = {u.dot(p), v.dot(p)};
    const double height = normal.dot(p);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const std::vector<Vector2d> hull = convex_hull(std::move(footprint));
  const auto box_with_side = [&](const Vector3d& side) {
    const Vector3d first = pointing_forward(side), second = normal.cross(first);
    const Vector2d a(u.dot(first), v.dot(first)), b(-a[1], a[0]);
    Vector2d least(kInfinity, kInfinity), most = -least;
    for (const Vector2d& p : hull) {
      const Vector2d q(a.dot(p), b.dot(p));
      least = least.cwiseMin(q);
      most = most.cwiseMax(q);
    }
    const Vector2d middle = (least + most) / 2, size = most - least;
    const Vector3d centre = middle[0] * first + middle[1] * second + (low + high) / 2 * normal;
    return OrientedBox{
        array(centre), {array(first), array(second), up}, {size[0], size[1], high - low}};
  };
  const Vector2d along = direction_of_smallest_rectangle(hull);
  const OrientedBox box = box_with_side(along[0] * u + along[1] * v);
  return box.size[0] >= box.size[1] ? box : box_with_side(vector(box.axes[1]));
}

std::array<Vec3, 3> principal_axes(const Points& places, std::span<const double> weights,
                                   const Vec3& viewpoint) {
  Vector3d mean = Vector3d::Zero();
  double sum = 0;
  for (Index i = 0; i < places.rows(); ++i) {
    mean += weights[static_cast<std::size_t>(i)] * Vector3d(places.row(i));
    sum += weights[static_cast<std::size_t>(i)];
  }
  mean /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Index i = 0; i < places.rows(); ++i) {
    const Vector3d d = Vector3d(places.row(i)) - mean;
    covariance += weights[static_cast<std::size_t>(i)] * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);  // least first
  Vector3d last = solver.eigenvectors().col(0);
  if (last.dot(vector(viewpoint) - mean) < 0) last = -last;
  const Vector3d first = pointing_forward(solver.eigenvectors().col(2));
  return {array(first), array(last.cross(first)), array(last)};
}

}  // namespace ph::segment
