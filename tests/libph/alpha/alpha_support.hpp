// SPDX-License-Identifier: MIT
#pragma once
// Generates points that are difficult for an alpha complex.
#include <cmath>
#include <string>
#include <vector>

#include "ph/alpha.hpp"
#include "ph/persistence.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {

struct Cloud {
  std::string name;
  Points points;
  std::vector<double> weights;

  AlphaOptions options() const { return {.weights = weights, .unit = AlphaOptions::Unit::squared}; }
};

/// A few points of a random kind in space: anywhere; on a grid or a small grid, where many points
/// coincide or lie on the same sphere, plane or line; on a sphere or a line; in or near a plane; on
/// a grid whose coordinates are not exact as doubles. With one or two dimensions, only the first
/// coordinates are kept. In a quarter of the clouds, some points are duplicated.
inline Cloud any_cloud(Generator& random, Index most, bool weighted) {
  const Index dim = random.integer(1, 5) == 1 ? 1 : random.integer(2, 3);
  const Index n = random.integer(1, static_cast<int>(most));
  Cloud cloud{"", Points(n, dim), {}};
  const int kind = random.integer(0, 7);
  const bool has_copies = random.integer(0, 3) == 0;
  static constexpr const char* names[]{"anywhere", "grid",  "small grid",   "sphere",
                                       "line",     "plane", "near a plane", "decimals"};
  cloud.name = names[kind] + std::string(" in R^") + std::to_string(dim);
  for (Index i = 0; i < n; ++i) {
    std::vector<double> x(3);
    const double s = random.integer(-4, 4), t = random.integer(-4, 4);
    for (double& c : x) {
      c = random.real();
      if (kind == 1) c = random.integer(0, 4);
      if (kind == 2) c = random.integer(0, 1);
      if (kind == 7) c = random.integer(0, 4) * 0.1 + 0.3;  // on spheres up to rounding
    }
    if (kind == 3) {  // integer points exactly on a sphere
      static constexpr int on_sphere[][3]{{9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {4, 4, 7},
                                          {4, 7, 4}, {7, 4, 4}, {1, 4, 8}, {8, 1, 4},
                                          {4, 8, 1}, {6, 6, 3}, {6, 3, 6}, {3, 6, 6}};
      const auto& at = on_sphere[random.integer(0, 11)];
      for (std::size_t k = 0; k < 3; ++k) x[k] = random.coin() ? at[k] : -at[k];
    }
    if (kind == 4) x = {s, 2 * s, -s};
    if (kind == 5) x = {s + t, s - t, 2 * t};
    if (kind == 6) x[2] = 0.3 * x[0] + 0.7 * x[1] + (i % 2 == 0 ? 1e-8 : 1e-15) * x[2];
    for (Index k = 0; k < dim; ++k) cloud.points(i, k) = x[static_cast<std::size_t>(k)];
    if (has_copies && i > 0 && random.integer(0, 2) == 0) {
      const Index of = random.integer(0, static_cast<int>(i) - 1);
      for (Index k = 0; k < dim; ++k) cloud.points(i, k) = cloud.points(of, k);
    }
    if (weighted)
      cloud.weights.push_back(random.coin() ? random.integer(-1, 3) : random.real() / 4);
  }
  return cloud;
}

inline Points times(const Points& points, double factor) {
  Points result = points;
  for (double& x : result.coordinates()) x *= factor;
  return result;
}

/// Points distributed uniformly in the unit cube.
inline Points uniform_points(Index n, Index dim, std::uint64_t seed) {
  Generator random(seed);
  return random.points(n, dim, false);
}

}  // namespace ph::test
