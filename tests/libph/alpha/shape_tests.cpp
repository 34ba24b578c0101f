// SPDX-License-Identifier: MIT
// Compares alpha shapes and wraps with sets of simplices that are found by the definition.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ph/detail/facade/alpha_engines.hpp"
#include "tests/libph/alpha/alpha_support.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

using Simplex = std::vector<Index>;

/// All simplices of the complex with their values.
std::map<Simplex, double> simplices_of(const Alpha& alpha) {
  std::map<Simplex, double> all;
  for (int dim = 0; dim <= alpha.top_dim(); ++dim)
    alpha.for_each_cell(dim, [&](const Alpha::Cell& cell) {
      Simplex simplex;
      alpha.append_input_cell(dim, cell, simplex);
      all.emplace(simplex, alpha.value(cell));
    });
  return all;
}

/// The facets of a simplex.
std::vector<Simplex> facets_of(const Simplex& simplex) {
  std::vector<Simplex> facets;
  for (std::size_t i = 0; simplex.size() > 1 && i < simplex.size(); ++i) {
    facets.push_back(simplex);
    facets.back().erase(facets.back().begin() + static_cast<std::ptrdiff_t>(i));
  }
  return facets;
}

/// The triangles that are not facets of exactly two tetrahedra of the set. For each triangle, the
/// number of tetrahedra of which it is a facet.
std::map<Simplex, int> surface_of(const std::set<Simplex>& set) {
  std::map<Simplex, int> sides;
  for (const Simplex& simplex : set)
    if (simplex.size() == 3) sides.emplace(simplex, 0);
  for (const Simplex& simplex : set)
    if (simplex.size() == 4)
      for (const Simplex& facet : facets_of(simplex)) ++sides.at(facet);
  std::erase_if(sides, [](const auto& side) { return side.second == 2; });
  return sides;
}

void expect_surface(const SurfaceMesh& mesh, const std::set<Simplex>& set) {
  std::map<Simplex, int> found;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Simplex triangle(mesh.triangles[i].begin(), mesh.triangles[i].end());
    std::ranges::sort(triangle);
    EXPECT_TRUE(found.emplace(triangle, i < mesh.regular ? 1 : 0).second);
  }
  EXPECT_EQ(found, surface_of(set));
}

/// Six times the volume enclosed by the regular triangles.
double volume(const Points& points, const SurfaceMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.regular; ++i) {
    const auto x = [&](std::size_t k) { return points.row(mesh.triangles[i][k]); };
    const auto a = x(0), b = x(1), c = x(2);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

TEST(AlphaShapes, AreTheSurfacesOfTheSimplices) {
  for_each_seed(40, [](Generator& random, bool weighted, std::int64_t) {
    Cloud cloud{"", random.points(30, 3, random.coin()), {}};
    for (Index i = 0; weighted && i < 30; ++i) cloud.weights.push_back(random.real() / 8);
    const Alpha alpha(cloud.points, cloud.options());
    const auto all = simplices_of(alpha);
    for (const double value : {0.01, 0.05, 0.2, 1.5, kInfinity}) {
      std::set<Simplex> set;
      for (const auto& [simplex, at] : all)
        if (at <= value) set.insert(simplex);
      if (alpha.top_dim() == 3) expect_surface(alpha_shape(alpha, value), set);
    }
  });
}

// In general position, each interval of simplices has its own value. A simplex that is alone in its
// interval is critical.
TEST(AlphaShapes, WrapsAreWhatLiesBelowCriticalSimplices) {
  for_each_seed(40, [](Generator& random, bool weighted, std::int64_t) {
    Cloud cloud{"", random.points(40, 3, false), {}};
    for (Index i = 0; weighted && i < 40; ++i) cloud.weights.push_back(random.real() / 8);
    const Alpha alpha(cloud.points, cloud.options());
    const auto all = simplices_of(alpha);
    std::map<double, std::vector<Simplex>> intervals;
    for (const auto& [simplex, value] : all)
      if (value != 0) intervals[value].push_back(simplex);
    for (const double limit : {0.02, 0.05, 0.1, kInfinity}) {
      std::set<Simplex> set;
      std::vector<Simplex> left;
      for (const auto& [value, members] : intervals)
        if (value <= limit && members.size() == 1) left.push_back(members[0]);
      while (!left.empty()) {
        const Simplex simplex = left.back();
        left.pop_back();
        if (!set.insert(simplex).second) continue;
        for (const Simplex& facet : facets_of(simplex)) left.push_back(facet);
        if (all.at(simplex) != 0)
          for (const Simplex& other : intervals.at(all.at(simplex))) left.push_back(other);
      }
      const SurfaceMesh mesh = wrap(alpha, limit);
      expect_surface(mesh, set);
      EXPECT_LE(volume(cloud.points, mesh),
                volume(cloud.points, alpha_shape(alpha, limit)) + 1e-12);
    }
  });
}

TEST(AlphaShapes, FaceOutwards) {
  Points grid(125, 3);
  for (Index i = 0; i < 125; ++i)
    for (Index k = 0; k < 3; ++k)
      grid(i, k) = static_cast<double>(i / (k == 0 ? 25 : k == 1 ? 5 : 1) % 5);
  const SurfaceMesh cube = alpha_shape(Alpha(grid), 0.9);
  EXPECT_EQ(volume(grid, cube), 6 * 64.0);
  EXPECT_EQ(cube.regular, cube.triangles.size());
  EXPECT_EQ(cube.triangles.size(), 2 * 6 * 16U);
  // Before the cubes are filled, their squares are surfaces that enclose no solid.
  const SurfaceMesh walls = alpha_shape(Alpha(grid), 0.8);
  EXPECT_EQ(walls.regular, 0U);
  EXPECT_GE(walls.triangles.size(), 2 * (3 * 5 * 16U));
  const SurfaceMesh square = alpha_shape(Alpha(Points{{0, 0}, {2, 0}, {2, 2}, {0, 2}}), 2);
  ASSERT_EQ(square.triangles.size(), 2U);
  expect_error(ErrorKind::usage, "nan", [&] { alpha_shape(Alpha(grid), std::nan("")); });
  expect_error(ErrorKind::usage, "nan", [&] { wrap(Alpha(grid), std::nan("")); });
  EXPECT_TRUE(alpha_shape(Alpha(Points(1, 3)), 1).triangles.empty());
  EXPECT_TRUE(wrap(Alpha(Points(1, 3)), 1).triangles.empty());
}

}  // namespace
}  // namespace ph::test
