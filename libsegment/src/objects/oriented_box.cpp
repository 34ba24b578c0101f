// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/oriented_box.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "ph/detail/core/raw_vector.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 array(const Vector3d& v) { return {v[0], v[1], v[2]}; }

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The coordinate of each point along an axis.
template <class T>
RawVector<T> coordinates(const Coordinates& points, const Vector3d& axis) {
  RawVector<T> result(points.x.size());
  const auto a = static_cast<T>(axis[0]), b = static_cast<T>(axis[1]), c = static_cast<T>(axis[2]);
  const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
  T* to = result.data();
  for (std::size_t i = 0; i < result.size(); ++i) to[i] = a * T{x[i]} + b * T{y[i]} + c * T{z[i]};
  return result;
}

/// The smallest and the largest of some numbers, found by comparing many numbers at a time.
template <class T>
std::pair<T, T> range_of(std::span<const T> numbers) {
  constexpr std::size_t lanes = 16;
  constexpr T infinite = std::numeric_limits<T>::infinity();
  std::array<T, lanes> low, high;
  low.fill(infinite);
  high.fill(-infinite);
  const auto see = [&](std::size_t lane, T x) {
    low[lane] = x < low[lane] ? x : low[lane];
    high[lane] = x > high[lane] ? x : high[lane];
  };
  std::size_t i = 0;
  for (; i + lanes <= numbers.size(); i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) see(lane, numbers[i + lane]);
  for (; i < numbers.size(); ++i) see(0, numbers[i]);
  return {std::ranges::min(low), std::ranges::max(high)};
}

/// The points that are farthest along x, x + y, y, y - x, and in the opposite directions. They are
/// the corners of an octagon, in counter-clockwise order. @param step only every step-th point is
/// considered.
template <class T>
std::array<std::array<T, 2>, 8> octagon(std::span<const T> u, std::span<const T> v,
                                        std::size_t step) {
  std::array<T, 4> most, least;
  most.fill(-std::numeric_limits<T>::infinity());
  least.fill(std::numeric_limits<T>::infinity());
  std::array<std::array<T, 2>, 8> corners{};
  for (std::size_t i = 0; i < u.size(); i += step) {
    const std::array<T, 4> along{u[i], u[i] + v[i], v[i], v[i] - u[i]};
    for (std::size_t k = 0; k < along.size(); ++k) {
      if (along[k] > most[k]) {
        most[k] = along[k];
        corners[k] = {u[i], v[i]};
      }
      if (along[k] < least[k]) {
        least[k] = along[k];
        corners[k + along.size()] = {u[i], v[i]};
      }
    }
  }
  return corners;
}

/// The numbers of the points that may be on the hull. They are all points except the points inside
/// the octagon (after Akl & Toussaint 1978). @param height the largest coordinate perpendicular to
/// the plane, whose rounding error must also be allowed for.
template <class T>
std::vector<std::size_t> outside_octagon(std::span<const T> u, std::span<const T> v,
                                         std::size_t step, T height) {
  constexpr T rounding = 64 * std::numeric_limits<T>::epsilon(), too_large = 1e18F;
  const auto corner = octagon(u, v, step);
  T reach = height;
  for (const auto& [x, y] : corner) reach = std::max({reach, std::abs(x), std::abs(y)});
  // A point is on the inner side of an edge, by more than the rounding error, if a x + b y > c.
  std::array<T, 8> a, b, c;
  bool has_edges = false;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const auto &from = corner[k], &to = corner[(k + 1) % corner.size()];
    a[k] = from[1] - to[1];
    b[k] = to[0] - from[0];
    const T length = std::abs(a[k]) + std::abs(b[k]);
    has_edges = has_edges || length > 0;
    c[k] = length == 0 ? -std::numeric_limits<T>::infinity()
                       : a[k] * from[0] + b[k] * from[1] + rounding * reach * length;
  }
  // Beyond this limit, products overflow.
  const bool has_inside = has_edges && reach < too_large;
  RawVector<T> inside(u.size());  // positive for a point inside the octagon
  for (std::size_t i = 0; i < inside.size(); ++i) {
    T nearest = std::numeric_limits<T>::infinity();
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const T distance = a[k] * u[i] + b[k] * v[i] - c[k];
      nearest = distance < nearest ? distance : nearest;
    }
    inside[i] = nearest;
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (!has_inside || !(inside[i] > 0)) result.push_back(i);
  return result;
}

/// The projections, onto the plane with axes u and v, of all points that may be on the hull. An
/// octagon of some of the points rules out nearly all points in single precision. The octagon of
/// the remaining points then rules out most of these points in double precision.
std::vector<Vector2d> outer_places(const Coordinates& points, const Vector3d& u, const Vector3d& v,
                                   double height) {
  constexpr std::size_t step = 8;
  RawVector<double> at_u, at_v;
  for (const std::size_t i :
       outside_octagon<float>(coordinates<float>(points, u), coordinates<float>(points, v), step,
                              static_cast<float>(height))) {
    const Vector3d p(points.x[i], points.y[i], points.z[i]);
    at_u.push_back(u.dot(p));
    at_v.push_back(v.dot(p));
  }
  std::vector<Vector2d> places;
  for (const std::size_t i : outside_octagon<double>(at_u, at_v, 1, height))
    places.push_back({at_u[i], at_v[i]});
  return places;
}

/// The corners of the convex hull in counter-clockwise order, by Andrew's monotone chain.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
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
  hull.pop_back();  // the last corner is the first one again
  return hull;
}

/// The direction of one side of the smallest rectangle around a convex polygon.
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

/// Returns the direction or its opposite, whichever has a positive largest coordinate.
Vector3d pointing_forward(const Vector3d& direction) {
  Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? Vector3d(-direction) : direction;
}

}  // namespace

Box box_around(const Coordinates& points) {
  Box box;
  for (std::size_t k = 0; k < 3; ++k)
    std::tie(box.min[k], box.max[k]) = range_of(std::array{points.x, points.y, points.z}[k]);
  return box;
}

OrientedBox box_on_plane(const CloudView& cloud, const std::vector<Index>& points, const Vec3& up) {
  if (points.empty()) return {};
  std::array<RawVector<float>, 3> all;
  for (RawVector<float>& of_axis : all) of_axis.reserve(points.size());
  for (const Index i : points)
    for (std::size_t k = 0; k < 3; ++k)
      all[k].push_back(cloud.point(static_cast<std::size_t>(i))[k]);
  return box_on_plane(Coordinates{all[0], all[1], all[2]}, up);
}

OrientedBox box_along(const Coordinates& points, const std::array<Vec3, 3>& axes) {
  OrientedBox box{{}, axes, {}};
  Vector3d centre = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d axis = vector(axes[k]);
    const auto [low, high] = range_of<double>(coordinates<double>(points, axis));
    centre += (low + high) / 2 * axis;
    box.size[k] = high - low;
  }
  box.centre = array(centre);
  return box;
}

OrientedBox box_on_plane(const Coordinates& points, const Vec3& up) {
  const Vector3d normal = vector(up);
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto [low, high] = range_of<double>(coordinates<double>(points, normal));
  const double height = std::max(std::abs(low), std::abs(high));
  const std::vector<Vector2d> hull = convex_hull(outer_places(points, u, v, height));
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
    mean += weights[static_cast<std::size_t>(i)] * Vector3d(as_matrix(places).row(i));
    sum += weights[static_cast<std::size_t>(i)];
  }
  mean /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Index i = 0; i < places.rows(); ++i) {
    const Vector3d d = Vector3d(as_matrix(places).row(i)) - mean;
    covariance += weights[static_cast<std::size_t>(i)] * d * d.transpose();
  }
  // The eigenvalues are in ascending order.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Vector3d last = solver.eigenvectors().col(0);
  if (last.dot(vector(viewpoint) - mean) < 0) last = -last;
  const Vector3d first = pointing_forward(solver.eigenvectors().col(2));
  return {array(first), array(last.cross(first)), array(last)};
}

}  // namespace ph::segment
