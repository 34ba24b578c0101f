// SPDX-License-Identifier: MIT
#include "libph/src/alpha/intervals/spheres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libph/src/alpha/intervals/double_double.hpp"
#include "libph/src/alpha/sites/squared_radius.hpp"
#include "libph/src/alpha/triangulation/triangulations.hpp"

namespace ph::alpha {
namespace {

using P = Vector<double>;
using std::uint32_t;

// Products smaller than this bound may have lost bits to underflow.
constexpr double kTiny = 1e-280;
// The corresponding bound for a factor: the product of two numbers above it is safe.
constexpr double kSmall = 1e-140;

}  // namespace

bool Spheres::lies_inside(const Faces& face, std::size_t count, std::size_t k) const {
  std::array<WeightedSite, 3> others;
  std::size_t size = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (i != k) others[size++] = {sites_.points[face[i]], sites_.weight(face[i])};
  return is_inside(std::span(others).first(size), {sites_.points[face[k]], sites_.weight(face[k])});
}

template <std::size_t N>
std::uint8_t Spheres::signs(const std::array<double, N>& values, double bound,
                            const Faces& face) const {
  std::uint8_t negative = 0;
  for (std::size_t k = 0; k < N; ++k) {
    if (values[k] > bound) continue;
    if (values[k] < -bound || lies_inside(face, N, k))  // mutant: alpha-beyond-facet
      negative = static_cast<std::uint8_t>(negative | 1U << k);
  }
  return negative;
}

double Spheres::careful_radius(const Faces& face, std::size_t count) const {
  // Coordinates are scaled by the longest edge, which avoids overflow and underflow.
  double longest = 0;
  const P origin = sites_.points[face[count - 1]];
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const P to = sites_.points[face[i]] - origin;
    longest = std::max({longest, std::abs(to.x), std::abs(to.y), std::abs(to.z)});
  }
  double heaviest = 0;
  for (std::size_t i = 0; i < count; ++i)
    heaviest = std::max(heaviest, std::abs(sites_.weight(face[i])));
  const int exponent = std::ilogb(std::max(longest, std::sqrt(heaviest)));
  std::array<Vector<DoubleDouble>, 4> points;
  std::array<DoubleDouble, 4> weights;
  for (std::size_t i = 0; i < count; ++i) {
    const P& p = sites_.points[face[i]];
    const auto scaled = [&](double x, double from) {
      const DoubleDouble difference = DoubleDouble(x) - DoubleDouble(from);
      return difference.times_power_of_two(-exponent);
    };
    points[i] = {scaled(p.x, origin.x), scaled(p.y, origin.y), scaled(p.z, origin.z)};
    weights[i] = DoubleDouble(std::ldexp(sites_.weight(face[i]), -2 * exponent));
  }
  // If a simplex is very flat, or very small compared with its weights, rounding errors leave too
  // few correct bits for a double, even in a computation with 106 bits. The radius of such a
  // simplex is computed exactly.
  const Vector<DoubleDouble> u = points[0], v = points[1], normal = cross(u, v);
  // mutant: alpha-edge-size
  const double size = count == 4   ? std::abs(dot(normal, points[2]).high())
                      : count == 3 ? std::sqrt(dot(normal, normal).high())
                                   : std::sqrt(dot(u, u).high());
  constexpr double flattest = 0x1p-40;
  if (size > flattest) {  // mutant: alpha-very-flat
    const DoubleDouble radius = squared_radius<DoubleDouble>(
        std::span(points).first(count), std::span<const DoubleDouble>(weights));
    return std::ldexp(radius.high(), 2 * exponent);
  }
  std::array<WeightedSite, 4> sites;
  for (std::size_t i = 0; i < count; ++i)
    sites[i] = {sites_.points[face[i]], sites_.weight(face[i])};
  return exact_squared_radius(std::span(sites).first(count));
}

Sphere Spheres::of_edge(uint32_t a, uint32_t b) const {
  const P to = sites_.points[b] - sites_.points[a];
  const double squared = dot(to, to);
  if (!sites_.is_weighted()) {
    if (squared > kTiny) return {squared / 4, 0};
    return {careful_radius({a, b}, 2), 0};
  }
  // The centre is a + s (b - a), where 2 s |b - a|² = |b - a|² + w_a - w_b.
  const double difference = sites_.weights[a] - sites_.weights[b];
  const double at_b = squared + difference, at_a = squared - difference;
  const double bound = 1e-15 * (squared + std::abs(difference)) + kTiny;
  Sphere sphere;
  sphere.beyond = signs<2>({at_a, at_b}, bound, {a, b});
  // mutant: alpha-underflow
  sphere.squared_radius = squared > kSmall ? at_b * at_b / (4 * squared) - sites_.weights[a]
                                           : careful_radius({a, b}, 2);
  return sphere;
}

std::uint8_t Spheres::beyond_triangle(uint32_t a, uint32_t b, uint32_t c) const {
  const P &p = sites_.points[a], &q = sites_.points[b], &r = sites_.points[c];
  const P u = q - p, v = r - p;
  if (!sites_.is_weighted()) {
    // The centre lies beyond the edge opposite an obtuse angle.
    const P w = r - q;
    const double at_a = dot(u, v), at_b = -dot(u, w), at_c = dot(v, w);
    const double bound = 2e-15 * (dot(u, u) + dot(v, v)) + kTiny;  // mutant: alpha-angle-bound
    return signs<3>({at_a, at_b, at_c}, bound, {a, b, c});
  }
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
  const double from_b = sites_.weights[a] - sites_.weights[b];
  const double from_c = sites_.weights[a] - sites_.weights[c];
  const double U = uu + from_b, V = vv + from_c;
  const double at_b = U * vv - V * uv, at_c = V * uu - U * uv;
  const double at_a = 2 * (uu * vv - uv * uv) - at_b - at_c;
  const double longest = std::max(uu, vv);
  const double lifted = longest + std::max(std::abs(from_b), std::abs(from_c));
  // mutant: alpha-triangle-bound
  return signs<3>({at_a, at_b, at_c}, 4e-14 * longest * lifted + kTiny, {a, b, c});
}

double Spheres::triangle_radius(uint32_t a, uint32_t b, uint32_t c) const {
  const P &p = sites_.points[a], &q = sites_.points[b], &r = sites_.points[c];
  const P u = q - p, v = r - p, normal = cross(u, v);
  const double uu = dot(u, u), vv = dot(v, v), area = dot(normal, normal);
  const double longest = std::max(uu, vv);
  // The relative error of the radius is as large as the relative error of the area.
  constexpr double flat = 0x1p-20;
  if (area < flat * longest * longest || area < kSmall) return careful_radius({a, b, c}, 3);
  if (!sites_.is_weighted()) {
    const P w = r - q;
    return uu * vv * dot(w, w) / (4 * area);
  }
  const double U = uu + (sites_.weights[a] - sites_.weights[b]);
  const double V = vv + (sites_.weights[a] - sites_.weights[c]);
  // Squares the norm of a difference of vectors. Subtracting numbers as large as U² vv instead
  // would lose too many digits.
  const P n = U * v - V * u;
  return dot(n, n) / (4 * area) - sites_.weights[a];
}

Sphere Spheres::of_tetrahedron(const std::array<uint32_t, 4>& cell) const {
  const P& d = sites_.points[cell[3]];
  const P u = sites_.points[cell[0]] - d, v = sites_.points[cell[1]] - d,
          w = sites_.points[cell[2]] - d;
  double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const double longest = std::max({uu, vv, ww});
  double lifted = longest, weight = 0;
  if (sites_.is_weighted()) {
    weight = sites_.weights[cell[3]];
    const auto lift = [&](std::size_t k, double& squared) {
      const double difference = weight - sites_.weights[cell[k]];
      squared += difference;
      lifted = std::max(lifted, longest + std::abs(difference));
    };
    lift(0, uu);
    lift(1, vv);
    lift(2, ww);
  }
  const P vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double det = dot(u, vw);
  const P n{uu * vw.x + vv * wu.x + ww * uv.x, uu * vw.y + vv * wu.y + ww * uv.y,
            uu * vw.z + vv * wu.z + ww * uv.z};
  const double at_a = dot(n, vw), at_b = dot(n, wu), at_c = dot(n, uv);
  const double det2 = det * det;
  const double at_d = 2 * det2 - (at_a + at_b + at_c);  // mutant: alpha-last-vertex
  // mutant: alpha-tetrahedron-bound
  const double bound = 8e-14 * lifted * longest * longest + kTiny;
  Sphere sphere;
  sphere.beyond = signs<4>({at_a, at_b, at_c, at_d}, bound, cell);
  constexpr double flat = 0x1p-20;
  if (det2 < flat * longest * longest * longest || det2 < kSmall)  // mutant: alpha-flat
    sphere.squared_radius = careful_radius(cell, 4);
  else
    sphere.squared_radius = dot(n, n) / (4 * det2) - weight;
  return sphere;
}

}  // namespace ph::alpha
