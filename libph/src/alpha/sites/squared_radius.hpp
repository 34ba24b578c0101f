// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>

#include "libph/src/alpha/sites/vector.hpp"

namespace ph::alpha {

/// The squared radius of the smallest sphere through two, three or four points. With weights, the
/// sphere is orthogonal to the points instead: the squared radius is |z - p|² - w for each point,
/// where z is the centre.
/// @tparam T a number type with more than double precision.
template <class T>
T squared_radius(std::span<const Vector<T>> points, std::span<const T> weights) {
  const Vector<T>& origin = points.back();
  const T& weight = weights[points.size() - 1];
  const auto lifted = [&](std::size_t i, const Vector<T>& to) -> T {
    return dot(to, to) - weights[i] + weight;  // mutant: alpha-lift
  };
  const Vector<T> u = points[0] - origin;
  const T a = lifted(0, u);
  if (points.size() == 2) return a * a / (T(4) * dot(u, u)) - weight;
  const Vector<T> v = points[1] - origin;
  const T b = lifted(1, v);
  if (points.size() == 3) {
    const Vector<T> normal = cross(u, v), n = a * v - b * u;
    return dot(n, n) / (T(4) * dot(normal, normal)) - weight;
  }
  const Vector<T> w = points[2] - origin;
  const T c = lifted(2, w);
  const Vector<T> vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const Vector<T> n = a * vw + b * wu + c * uv;
  const T det = dot(u, vw);
  return dot(n, n) / (T(4) * det * det) - weight;
}

}  // namespace ph::alpha
