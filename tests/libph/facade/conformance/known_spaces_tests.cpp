// SPDX-License-Identifier: MIT
// Spaces with known homology: runs the whole suite on each space, and compares its homology with
// textbooks.
#include "tests/support/known_spaces.hpp"

#include "tests/support/conformance.hpp"

namespace ph::test {
namespace {

using Betti = std::vector<int>;
using Intervals = std::vector<std::pair<double, double>>;
constexpr double kInf = kInfinity;

// The classes that never die are the homology of the space, in whatever order the space is built.
void expect_homology(const Simplices& space, int top, std::int64_t field, const Betti& expected) {
  for (const auto& complex : {all_at_once(space), vertex_by_vertex(space)}) {
    EXPECT_EQ(complex.top_dim(), top);
    ASSERT_NO_FATAL_FAILURE(check(complex, top, {field}));
    const Barcode barcode = persistence(complex, {.field = field});
    EXPECT_EQ(betti_at_the_end(barcode, top), expected) << "over Z/" << field;
  }
}

TEST(KnownSpaces, TorusHasTheSameHomologyOverEveryField) {
  for (const std::int64_t field : {2, 3, 5, 11}) {
    expect_homology(torus_of_seven_vertices(), 2, field, {1, 2, 1});
    expect_homology(glued_grid(4, false), 2, field, {1, 2, 1});
  }
}

TEST(KnownSpaces, KleinBottleDiffersBetweenTwoAndThree) {
  const ExplicitComplex klein = all_at_once(klein_bottle());
  ASSERT_EQ(klein.size(), 16U + 48U + 32U) << "gluing must not merge simplices";
  expect_homology(klein_bottle(), 2, 2, {1, 2, 1});
  for (const std::int64_t field : {3, 5, 11}) expect_homology(klein_bottle(), 2, field, {1, 1, 0});
}

TEST(KnownSpaces, ProjectivePlaneDiffersBetweenTwoAndThree) {
  expect_homology(projective_plane(), 2, 2, {1, 1, 1});
  for (const std::int64_t field : {3, 5, 11})
    expect_homology(projective_plane(), 2, field, {1, 0, 0});
}

TEST(KnownSpaces, SuspensionMovesHomologyUp) {
  expect_homology(suspension(projective_plane()), 3, 2, {1, 0, 1, 1});
  expect_homology(suspension(projective_plane()), 3, 3, {1, 0, 0, 0});
  expect_homology(suspension(torus_of_seven_vertices()), 3, 5, {1, 0, 2, 1});
}

TEST(KnownSpaces, WedgeAddsHomologyUp) {
  const auto circle_and_sphere = wedge(simplex_boundary(1), simplex_boundary(2));
  expect_homology(circle_and_sphere, 2, 2, {1, 1, 1});
  expect_homology(wedge(projective_plane(), klein_bottle()), 2, 2, {1, 3, 2});
  expect_homology(wedge(projective_plane(), klein_bottle()), 2, 3, {1, 1, 0});
}

TEST(KnownSpaces, SpheresUpToDimensionFour) {
  for (int dim = 1; dim <= 4; ++dim) {
    Betti sphere(static_cast<std::size_t>(dim) + 1, 0);
    sphere.front() = sphere.back() = 1;
    for (const std::int64_t field : {2, 3}) {
      expect_homology(simplex_boundary(dim), dim, field, sphere);
      expect_homology(cross_polytope(dim), dim, field, sphere);
    }
  }
  expect_homology(cross_polytope(0), 0, 2, {2});
}

// ---- Vietoris-Rips

// Adamaszek & Adams, The Vietoris-Rips complexes of a circle: the complex is homotopy equivalent to
// a circle as long as its edges are shorter than the side of an inscribed equilateral triangle.
TEST(KnownSpaces, RipsOfACircle) {
  for (const Index n : {4, 5, 6, 7, 9, 12}) {
    const Rips rips(circle(n));
    check(rips, 2);
    const Barcode barcode = persistence(rips, {.min_persistence = 1e-9});
    const auto loops = barcode.bars(1);
    ASSERT_EQ(loops.size(), 1U) << n;
    EXPECT_NEAR(loops[0].birth, chord(n, 1), 1e-14);
    EXPECT_NEAR(loops[0].death, chord(n, (n + 2) / 3), 1e-14);
    ASSERT_EQ(barcode.bars(0).size(), static_cast<std::size_t>(n));
    EXPECT_NEAR(barcode.bars(0)[0].death, chord(n, 1), 1e-14);
  }
}

// In the maximum metric, the complex of a product of spaces is homotopy equivalent to the product
// of their complexes.
TEST(KnownSpaces, RipsOfAFlatTorus) {
  const Rips small(FlatSurface{5, 5});
  check(small, 1, {2, 3});
  for (const Index n : {4, 5, 6, 7}) {
    const double end = static_cast<double>((n + 2) / 3);
    const Barcode barcode = persistence(Rips(FlatSurface{n, n}), {.max_dim = 2, .field = 3});
    EXPECT_EQ(intervals(barcode, 1), (Intervals{{1, end}, {1, end}})) << n;
    EXPECT_EQ(betti_at(barcode, 1, 2), (Betti{1, 2, 1})) << n;
  }
  const Barcode oblong = persistence(Rips(FlatSurface{7, 4}), {.max_dim = 1});
  EXPECT_EQ(intervals(oblong, 1), (Intervals{{1, 2}, {1, 3}}));
}

TEST(KnownSpaces, RipsOfAFlatKleinBottle) {
  const Rips rips(FlatSurface{5, 5, true}, {.threshold = 1.0});
  check(rips, 2, {2, 3});
  EXPECT_EQ(betti_at(persistence(rips, {.max_dim = 2, .field = 2}), 1, 2), (Betti{1, 2, 1}));
  EXPECT_EQ(betti_at(persistence(rips, {.max_dim = 2, .field = 3}), 1, 2), (Betti{1, 1, 0}));
  EXPECT_EQ(betti_at(persistence(rips, {.max_dim = 2, .field = 11}), 1, 2), (Betti{1, 1, 0}));
}

// The vertices are +-e_k in R^(d+1). Opposite vertices are 2 apart, and all other pairs are sqrt(2)
// apart.
TEST(KnownSpaces, RipsOfCrossPolytopes) {
  for (int dim = 1; dim <= 4; ++dim) {
    Points points(2 * (dim + 1), dim + 1);
    for (Index k = 0; k <= dim; ++k) {
      points(2 * k, k) = 1;
      points(2 * k + 1, k) = -1;
    }
    const Rips rips(points);
    EXPECT_EQ(all_edges(rips).threshold(), 2);
    check(rips, dim, {2, 3});
    const Barcode barcode = persistence(rips, {.max_dim = dim});
    const Intervals sphere{{std::sqrt(2.0), 2.0}};
    for (int k = 1; k <= dim; ++k)
      EXPECT_EQ(intervals(barcode, k), k == dim ? sphere : Intervals{});
  }
}

TEST(KnownSpaces, RipsOfARegularSimplexIsContractible) {
  for (Index n = 1; n <= 8; ++n) {
    const Rips rips(
        DistanceMatrix(n, std::vector<double>(static_cast<std::size_t>(n * (n - 1) / 2), 3.0)));
    check(rips, 3, {2, 3});
    const Barcode barcode = persistence(rips, {.max_dim = 3});
    Intervals components(static_cast<std::size_t>(n), {0, 3});
    components.back().second = kInf;
    EXPECT_EQ(intervals(barcode, 0), components);
    EXPECT_EQ(barcode.size(), static_cast<std::size_t>(n));
  }
}

// ---- lower stars

// The height function on the octahedron has a minimum, a maximum, and no other critical point.
TEST(KnownSpaces, HeightOfASphere) {
  const std::vector<double> height{0, 0, 0, 0, 1, -1};
  const ExplicitComplex mesh = filtered(cross_polytope(2), height);
  check(mesh, 2);
  EXPECT_EQ(bars_of(persistence(mesh)), (std::vector<Bar>{{0, -1, kInf}, {2, 1, kInf}}));
}

TEST(KnownSpaces, LowerStarOfGraphs) {
  const std::vector<double> values{0, 2, 1, 2};
  const std::vector<WeightedEdge> path{{0, 1, 9}, {2, 1, 9}};
  const ExplicitComplex line = lower_star(path, std::span(values).first(3));
  check(line, 1);
  EXPECT_EQ(bars_of(persistence(line)), (std::vector<Bar>{{0, 0, kInf}, {0, 1, 2}}));
  const std::vector<WeightedEdge> cycle{{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 0, 0}};
  const ExplicitComplex loop = lower_star(cycle, values);
  check(loop, 1);
  EXPECT_EQ(bars_of(persistence(loop)), (std::vector<Bar>{{0, 0, kInf}, {0, 1, 2}, {1, 2, kInf}}));
}

TEST(KnownSpaces, BirthsAtMinusInfinity) {
  const std::vector<double> values{-kInf, 1, -kInf, 0};
  const std::vector<WeightedEdge> path{{0, 1, 0}, {1, 2, 0}, {2, 3, 0}};
  const ExplicitComplex line = lower_star(path, values);
  check(line, 1);
  EXPECT_EQ(bars_of(persistence(line)), (std::vector<Bar>{{0, -kInf, 1}, {0, -kInf, kInf}}));
}

}  // namespace
}  // namespace ph::test
