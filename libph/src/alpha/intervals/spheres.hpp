// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "alpha/sites/sites.hpp"

namespace ph::alpha {

/// A face of the triangulation as its smallest empty-of-vertices sphere sees it: through its
/// vertices or, of weights, orthogonal to them.
struct Sphere {
  double squared_radius = 0;
  /// Bit k: the centre lies strictly beyond the facet opposite vertex k, as its barycentric
  /// coordinate tells. Then vertex k lies inside the smallest sphere of that facet.
  std::uint8_t beyond = 0;
};

/// Spheres of faces of a triangulation. Signs are exact: those that rounding may have turned are
/// computed anew. A radius has an error of some last places, however flat the face is.
class Spheres {
 public:
  explicit Spheres(const Sites& sites) : sites_(sites) {}

  Sphere of_edge(std::uint32_t a, std::uint32_t b) const;
  /// The signs alone.
  std::uint8_t beyond_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  double triangle_radius(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  Sphere of_tetrahedron(const std::array<std::uint32_t, 4>& cell) const;

 private:
  using Faces = std::array<std::uint32_t, 4>;
  /// Whether vertex k of the first `count` lies inside the smallest sphere of the others.
  bool lies_inside(const Faces& face, std::size_t count, std::size_t k) const;
  /// Signs of quantities that are known up to `bound`.
  template <std::size_t N>
  std::uint8_t signs(const std::array<double, N>& values, double bound, const Faces& face) const;
  double careful_radius(const Faces& face, std::size_t count) const;

  const Sites& sites_;
};

}  // namespace ph::alpha
