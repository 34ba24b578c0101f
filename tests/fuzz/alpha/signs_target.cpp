// SPDX-License-Identifier: MIT
// Signs and radii of the faces of alpha complexes against rationals.
#include "alpha/intervals/spheres.hpp"

#include <cmath>
#include <limits>
#include "libph/alpha/alpha_oracle.hpp"
#include "ph/error.hpp"
#include "sites_of_bytes.hpp"
#include "targets.hpp"
#include "violation.hpp"

namespace ph::fuzz {
namespace {

using test::Rational;

/// By squares, in units of the largest coordinate or root of a weight: below it they underflow.
const Rational kFloor = Rational(1e-300);

Rational magnitude(const Rational& x) { return x < 0 ? Rational(-x) : x; }

class Faces {
 public:
  explicit Faces(const alpha::Sites& sites) : sites_(sites), spheres_(sites) {
    for (std::uint32_t v = 0; v < sites.size(); ++v) {
      const auto& p = sites.points[v];
      points_.push_back({Rational(p.x), Rational(p.y), Rational(p.z)});
      weights_.emplace_back(sites.weight(v));
    }
  }

  void check(const std::vector<std::uint32_t>& face) const {
    std::vector<test::RationalPoint> points;
    std::vector<Rational> weights;
    for (const std::uint32_t v : face) {
      points.push_back(points_[v]);
      weights.push_back(weights_[v]);
    }
    const auto exact = test::exact_sphere(points, weights);
    if (!exact) return;  // flat: in no triangulation
    std::uint8_t beyond = 0;
    for (std::size_t k = 0; k < face.size(); ++k)
      if (exact->barycentric[k] < 0) beyond = static_cast<std::uint8_t>(beyond | 1U << k);
    const alpha::Sphere found = sphere_of(face);
    require(found.beyond == beyond, "the signs of a centre's coordinates are exact");
    require(is_near(found.squared_radius, *exact, points, weights),
            "a squared radius has an error of some last places");
  }

 private:
  alpha::Sphere sphere_of(const std::vector<std::uint32_t>& face) const {
    if (face.size() == 2) return spheres_.of_edge(face[0], face[1]);
    if (face.size() == 4) return spheres_.of_tetrahedron({face[0], face[1], face[2], face[3]});
    return {spheres_.triangle_radius(face[0], face[1], face[2]),
            spheres_.beyond_triangle(face[0], face[1], face[2])};
  }
  bool is_near(double found, const test::ExactSphere& exact,
               const std::vector<test::RationalPoint>& points,
               const std::vector<Rational>& weights) const {
    const Rational largest(std::numeric_limits<double>::max());
    if (!std::isfinite(found)) return false;
    if (exact.squared_radius > largest) return Rational(found) == largest;
    // Of weights what counts is the largest of what is added up: |z - p|² and w.
    Rational scale = magnitude(exact.squared_radius);
    if (sites_.is_weighted())
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto to = test::minus(points[i], exact.centre);
        scale = std::max<Rational>({scale, test::dot(to, to), magnitude(weights[i])});
      }
    constexpr double places = 0x1p-38;
    return magnitude(Rational(found) - exact.squared_radius) <= Rational(places) * scale + kFloor;
  }

  const alpha::Sites& sites_;
  const alpha::Spheres spheres_;
  std::vector<test::RationalPoint> points_;
  std::vector<Rational> weights_;
};

}  // namespace

void run_alpha_signs(std::string_view bytes) {
  SitesOfBytes choices(bytes);
  const Index coordinates = choices.choice(2) + 1, count = choices.choice(3) + 2;
  const bool weighted = choices.choice(1) == 1;
  const Points points = choices.points(count, coordinates);
  const std::vector<double> weights = weighted ? choices.weights(count) : std::vector<double>();
  RunContext context;
  std::optional<alpha::Sites> sites;
  try {
    sites.emplace(alpha::sites_of(points, weights, context));
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data, "numbers are refused as bad data");
    return;
  }
  const Faces faces(*sites);
  const auto size = static_cast<std::uint32_t>(sites->size());
  for (unsigned set = 1; set < 1U << size; ++set) {
    std::vector<std::uint32_t> face;
    for (std::uint32_t v = 0; v < size; ++v)
      if ((set >> v & 1) != 0) face.push_back(v);
    if (face.size() >= 2 && face.size() <= 4) faces.check(face);
  }
}

}  // namespace ph::fuzz
