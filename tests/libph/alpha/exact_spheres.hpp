// SPDX-License-Identifier: MIT
#pragma once
// Compares the signs and radii of the faces of alpha complexes with results in exact integers.
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "libph/src/alpha/intervals/spheres.hpp"

namespace ph::test {

using Integer = boost::multiprecision::cpp_int;
using IntegerPoint = std::array<Integer, 3>;

/// The least number of bits after the binary point. Coordinates are stored as multiples of 2^-bits,
/// and weights as multiples of 2^(-2 bits).
inline constexpr int kLeastBits = 540;

inline int bits_of(double x) {
  if (x == 0) return 0;
  constexpr int digits = std::numeric_limits<double>::digits;
  return digits - std::ilogb(x);
}
inline Integer integer_of(double x, int bits) {
  int exponent = 0;
  constexpr int digits = std::numeric_limits<double>::digits;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), digits);
  exponent += bits - digits;
  const Integer whole(static_cast<std::int64_t>(mantissa));
  return exponent < 0 ? Integer(whole >> -exponent) : Integer(whole << exponent);
}
inline Integer dot(const IntegerPoint& a, const IntegerPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The smallest sphere through points or, if the points have weights, orthogonal to them. Its
/// centre has the barycentric coordinates barycentric / determinant, and its squared radius is
/// radius / determinant².
struct IntegerSphere {
  std::vector<Integer> barycentric;
  Integer determinant, radius;
  std::vector<Integer> powers;  ///< the squared distances to the centre, times determinant²
};

inline Integer determinant(const std::vector<std::vector<Integer>>& m) {
  if (m.size() == 1) return m[0][0];
  if (m.size() == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Returns nothing if the points are affinely dependent.
inline std::optional<IntegerSphere> integer_sphere(const std::vector<IntegerPoint>& points,
                                                   const std::vector<Integer>& weights) {
  const std::size_t m = points.size() - 1;
  std::vector<IntegerPoint> to(m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < 3; ++k) to[i][k] = points[i + 1][k] - points[0][k];
  // Solves 2 <to_i, Σ x_j to_j> = |to_i|² - w_i + w_0 by Cramer's rule.
  std::vector<std::vector<Integer>> rows(m, std::vector<Integer>(m));
  std::vector<Integer> right(m);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) rows[i][j] = 2 * dot(to[i], to[j]);
    right[i] = dot(to[i], to[i]) - weights[i + 1] + weights[0];
  }
  IntegerSphere sphere{{0}, determinant(rows), 0, {}};
  if (sphere.determinant == 0) return std::nullopt;
  IntegerPoint centre{0, 0, 0};
  sphere.barycentric[0] = sphere.determinant;
  for (std::size_t j = 0; j < m; ++j) {
    auto replaced = rows;
    for (std::size_t i = 0; i < m; ++i) replaced[i][j] = right[i];
    const Integer x = determinant(replaced);
    sphere.barycentric.push_back(x);
    sphere.barycentric[0] -= x;
    for (std::size_t k = 0; k < 3; ++k) centre[k] += x * to[j][k];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    IntegerPoint from = centre;
    for (std::size_t k = 0; i > 0 && k < 3; ++k) from[k] -= sphere.determinant * to[i - 1][k];
    sphere.powers.push_back(dot(from, from));
  }
  sphere.radius = sphere.powers[0] - weights[0] * sphere.determinant * sphere.determinant;
  return sphere;
}

/// The faces spanned by any of the sites.
class Faces {
 public:
  explicit Faces(const alpha::Sites& sites) : sites_(sites), spheres_(sites) {
    for (std::uint32_t v = 0; v < sites.size(); ++v) {
      const auto& p = sites.points[v];
      bits_ = std::max({bits_, bits_of(p.x), bits_of(p.y), bits_of(p.z), bits_of(sites.weight(v))});
    }
    for (std::uint32_t v = 0; v < sites.size(); ++v) {
      const auto& p = sites.points[v];
      points_.push_back({integer_of(p.x, bits_), integer_of(p.y, bits_), integer_of(p.z, bits_)});
      weights_.push_back(integer_of(sites.weight(v), 2 * bits_));
    }
  }

  /// @return the property that the sphere of a face violates; empty if there is none.
  std::string_view violation(const std::vector<std::uint32_t>& face) const {
    std::vector<IntegerPoint> points;
    std::vector<Integer> weights;
    for (const std::uint32_t v : face) {
      points.push_back(points_[v]);
      weights.push_back(weights_[v]);
    }
    const auto exact = integer_sphere(points, weights);
    if (!exact) return "";  // a flat simplex, which no triangulation contains
    std::uint8_t beyond = 0;
    for (std::size_t k = 0; k < face.size(); ++k)
      if (exact->barycentric[k] < 0) beyond = static_cast<std::uint8_t>(beyond | 1U << k);
    const alpha::Sphere found = sphere_of(face);
    if (found.beyond != beyond) return "the signs of a centre's coordinates are exact";
    return is_near(found.squared_radius, *exact, weights)
               ? ""
               : "a squared radius has an error of some last places";
  }

  /// @return a property that the sphere of any face violates; empty if there is none.
  std::string_view violation() const {
    const auto size = static_cast<std::uint32_t>(sites_.size());
    for (unsigned set = 1; set < 1U << size; ++set) {
      std::vector<std::uint32_t> face;
      for (std::uint32_t v = 0; v < size; ++v)
        if ((set >> v & 1) != 0) face.push_back(v);
      if (face.size() < 2 || face.size() > 4) continue;
      if (const std::string_view found = violation(face); !found.empty()) return found;
    }
    return "";
  }

 private:
  alpha::Sphere sphere_of(const std::vector<std::uint32_t>& face) const {
    if (face.size() == 2) return spheres_.of_edge(face[0], face[1]);
    if (face.size() == 4) return spheres_.of_tetrahedron({face[0], face[1], face[2], face[3]});
    return {spheres_.triangle_radius(face[0], face[1], face[2]),
            spheres_.beyond_triangle(face[0], face[1], face[2])};
  }
  /// True if the number is exact up to a factor of 1 ± 2^-38. In units of the largest coordinate,
  /// an error of 1e-300 is also allowed, because smaller squares underflow.
  bool is_near(double found, const IntegerSphere& exact,
               const std::vector<Integer>& weights) const {
    constexpr double largest = std::numeric_limits<double>::max();
    if (!std::isfinite(found)) return false;
    const Integer denominator = exact.determinant * exact.determinant;
    const auto times = [&](double x) { return Integer(integer_of(x, 2 * bits_) * denominator); };
    if (exact.radius > times(largest)) return found == largest;
    // With weights, the error is relative to the largest summand, |z - p|² or w.
    Integer scale = abs(exact.radius);
    if (sites_.is_weighted())
      for (std::size_t i = 0; i < weights.size(); ++i)
        scale = std::max<Integer>({scale, exact.powers[i], Integer(abs(weights[i]) * denominator)});
    constexpr int places = 38;
    const Integer error = abs(Integer(times(found) - exact.radius));
    return error <= (scale >> places) + times(1e-300);
  }

  const alpha::Sites& sites_;
  const alpha::Spheres spheres_;
  int bits_ = kLeastBits;
  std::vector<IntegerPoint> points_;
  std::vector<Integer> weights_;
};

}  // namespace ph::test
