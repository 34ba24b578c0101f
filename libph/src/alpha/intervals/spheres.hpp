// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "libph/src/alpha/sites/sites.hpp"

namespace ph::alpha {

/// The smallest sphere of a face of the triangulation: it goes through the vertices or, with
/// weights, is orthogonal to them.
struct Sphere {
  double squared_radius = 0;
  /// Bit k is set if the centre lies strictly beyond the facet opposite vertex k, that is, if the
  /// barycentric coordinate of the centre at vertex k is negative. Vertex k then lies inside the
  /// smallest sphere of that facet.
  std::uint8_t beyond = 0;
};

/// Spheres of faces of a triangulation. Signs are exact: signs that rounding may have changed are
/// computed again. A radius is correct up to the last few places, however flat the face is.
class Spheres {
 public:
  explicit Spheres(const Sites& sites) : sites_(sites) {}

  Sphere of_edge(std::uint32_t a, std::uint32_t b) const;
  /// Computes only Sphere::beyond.
  std::uint8_t beyond_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  double triangle_radius(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  Sphere of_tetrahedron(const std::array<std::uint32_t, 4>& cell) const;

 private:
  using Faces = std::array<std::uint32_t, 4>;
  /// True if vertex k of the first `count` lies inside the smallest sphere of the others.
  bool lies_inside(const Faces& face, std::size_t count, std::size_t k) const;
  /// Returns a bit for each value, which is set if the value is negative. Values have errors up to
  /// `bound`; exact arithmetic decides the sign of a value that is closer to 0.
  template <std::size_t N>
  std::uint8_t signs(const std::array<double, N>& values, double bound, const Faces& face) const;
  double careful_radius(const Faces& face, std::size_t count) const;

  const Sites& sites_;
};

}  // namespace ph::alpha
