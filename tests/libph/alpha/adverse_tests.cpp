// SPDX-License-Identifier: MIT
// Alpha complexes of points that are difficult because of rounding, exact signs or the running
// time.
#include <gtest/gtest.h>

#include <cmath>

#include "ph/alpha.hpp"
#include "tests/libph/alpha/alpha_support.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

/// Random points that are on the unit sphere up to rounding.
Points on_sphere(Index n, std::uint64_t seed) {
  Generator random(seed);
  Points points(n, 3);
  for (Index i = 0; i < n; ++i) {
    double x[3], norm = 0;
    for (double& c : x) {
      c = random.real() - 0.5;
      norm += c * c;
    }
    for (Index k = 0; k < 3; ++k) points(i, k) = x[k] / std::sqrt(norm);
  }
  return points;
}

// Without a correction, rounding would put the values of many simplices in the wrong order.
TEST(AlphaAdverse, PointsNearlyOnASphere) {
  const Alpha alpha(on_sphere(400, 5));
  check_contract(alpha, 3, 2);
  const Barcode bars = persistence(alpha);
  EXPECT_EQ(first_difference(bars, persistence(alpha, {.engine = Engine::cohomology})), "");
  EXPECT_EQ(bars.bars(2).size(), 1U);
}

// The eight corners of a cube are on a sphere only up to rounding. The signs must still be exact
// for the rounded points.
TEST(AlphaAdverse, GridsThatDoublesCannotHold) {
  for (const double step : {0.1, 1.0 / 3, 0.7}) {
    Points grid(343, 3);
    for (Index i = 0; i < grid.rows(); ++i)
      for (Index k = 0; k < 3; ++k)
        grid(i, k) = 0.3 + step * static_cast<double>(i / (k == 0 ? 49 : k == 1 ? 7 : 1) % 7);
    const Alpha alpha(grid);
    check_contract(alpha, 3, 2);
    EXPECT_EQ(first_difference(persistence(alpha), persistence(alpha, {.engine = Engine::twist})),
              "");
  }
}

// The list of cells is an explicit complex, which refuses a face that enters after a coface.
TEST(AlphaAdverse, ManySimplicesOfNearlyOneValueAreInOrder) {
  EXPECT_NO_THROW(Alpha(on_sphere(20'000, 6)).listed());
}

// Compares the bars with the bars that another engine computes from the list of all cells. The list
// refuses a face that enters after a coface.
void check_adverse(const Points& points, std::size_t cells) {
  const Alpha alpha(points);
  EXPECT_EQ(alpha.top_dim(), 3);
  EXPECT_GE(alpha.simplex_counts()[3], cells);
  for (const std::int64_t field : {2, 3})
    EXPECT_EQ(first_difference(persistence(alpha, {.field = field}),
                               persistence(alpha, {.field = field, .engine = Engine::cohomology})),
              "");
}

TEST(AlphaAdverse, LinesThatHaveATetrahedronForEachTwoOfTheirEdges) {
  constexpr Index n = 40;
  Points points(2 * n, 3);
  for (Index i = 0; i < n; ++i) {
    points(i, 0) = static_cast<double>(i) / n;
    points(n + i, 1) = static_cast<double>(i) / n;
    points(n + i, 2) = 1;
  }
  check_adverse(points, static_cast<std::size_t>((n - 1) * (n - 1)));
}

TEST(AlphaAdverse, PlanesButForTheLastPlace) {
  Generator random(12);
  Points points(400, 3);
  for (Index i = 0; i < points.rows(); ++i) {
    points(i, 0) = i % 2 == 0 ? random.real() : random.integer(0, 9);
    points(i, 1) = i % 2 == 0 ? random.real() : random.integer(0, 9);
    points(i, 2) = std::nextafter(1.0, random.integer(0, 2));
  }
  check_adverse(points, 400);
}

// Points with integer coordinates that lie exactly on one sphere. For most simplices, the centre of
// the empty sphere is outside the simplex.
TEST(AlphaAdverse, AllPointsOnOneSphere) {
  constexpr int radius = 45, squared = radius * radius;
  std::vector<double> on;
  for (int x = -radius; x <= radius; ++x)
    for (int y = -radius; y <= radius; ++y)
      for (int z = -radius; z <= radius; ++z)
        if (x * x + y * y + z * z == squared) on.insert(on.end(), {x * 1.0, y * 1.0, z * 1.0});
  Points points(static_cast<Index>(on.size() / 3), 3);
  std::ranges::copy(on, points.coordinates().begin());
  check_adverse(points, 200);
  const Barcode bars = persistence(Alpha(points));
  ASSERT_EQ(bars.bars(2).size(), 1U);
  EXPECT_EQ(bars.bars(2)[0].death, radius);
}

TEST(AlphaAdverse, SquaresThatNoDoubleHolds) {
  AlphaOptions options{.unit = AlphaOptions::Unit::squared};
  for (const double unit : {1e200, 1e-160, 1e-200})
    expect_error(ErrorKind::bad_data, "for squared values; use radii instead",
                 [&] { Alpha(times(uniform_points(20, 3, 2), unit), options); });
  EXPECT_NO_THROW(Alpha(times(uniform_points(20, 3, 2), 1e150), options));
}

// The triangle is nearly flat. Even in units of the largest coordinate, the square of its radius
// exceeds the range of doubles.
TEST(AlphaAdverse, RadiiOfWhichNoDoubleHoldsTheSquare) {
  for (const bool weighted : {false, true}) {
    AlphaOptions options{.unit = AlphaOptions::Unit::squared};
    if (weighted) options.weights = {0, 0, 0.01};
    const Alpha alpha(Points{{0, 0}, {1, 0}, {0.5, 1e-200}}, options);
    EXPECT_EQ(alpha.top_dim(), 2);
    int triangles = 0;
    alpha.for_each_cell(2, [&](const auto&) { ++triangles; });
    EXPECT_EQ(triangles, 1);
    EXPECT_EQ(persistence(alpha, {.engine = Engine::standard}).size(), 3U);
    EXPECT_EQ(persistence(alpha).size(), 3U);
  }
}

// Products of squares underflow, but the squares themselves do not.
TEST(AlphaAdverse, WeightedPointsThatAreCloseBesideAFarOne) {
  const double distance = 1e-100;
  for (const Index dim : {2, 3}) {
    Points points(5, dim);
    for (Index k = 0; k < dim; ++k) points(k + 1, k) = distance;
    points(4, 0) = 1;
    AlphaOptions options{.unit = AlphaOptions::Unit::squared};
    const Barcode plain = persistence(Alpha(points, options));
    options.weights.assign(5, 0);
    const Barcode weighted = persistence(Alpha(points, options));
    EXPECT_GE(plain.size(), static_cast<std::size_t>(dim) + 1);
    ASSERT_EQ(weighted.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_DOUBLE_EQ(weighted[i].birth, plain[i].birth);
      EXPECT_DOUBLE_EQ(weighted[i].death, plain[i].death);
    }
  }
}

// All points but one lie in one cell of the space-filling curve that determines the order of the
// points.
TEST(AlphaAdverse, CopiesWithinACellOfTheCurve) {
  Points points(62, 3);
  for (Index i = 1; i < 61; ++i) points(i, 0) = 1e-9 * static_cast<double>(7 * i % 20);
  points(61, 2) = 1;
  const Alpha alpha(points);
  EXPECT_EQ(alpha.copies().size(), 41U);
  EXPECT_EQ(persistence(alpha).bars(0).size(), 21U);
}

TEST(AlphaAdverse, PointsNearlyOnACircle) {
  Generator random(13);
  Points points(500, 2);
  for (Index i = 0; i < points.rows(); ++i) {
    const double turn = 7 * random.real();
    points(i, 0) = std::cos(turn);
    points(i, 1) = std::sin(turn);
  }
  const Alpha alpha(points);
  EXPECT_EQ(first_difference(persistence(alpha), persistence(alpha, {.engine = Engine::twist})),
            "");
}

// Nearly all points are orthogonal to the same sphere. As a result, vertices enter late, and their
// values are nearly the same.
TEST(AlphaAdverse, WeightedPointsNearlyOnASphere) {
  int late = 0;
  for_each_seed(20, [&](Generator& random, bool, std::int64_t) {
    const Index dim = random.integer(1, 3), n = 60;
    const Points points = random.points(n, dim, false);
    AlphaOptions options{.unit = AlphaOptions::Unit::squared};
    for (Index i = 0; i < n; ++i) {
      double squared = 0;
      for (Index k = 0; k < dim; ++k) squared += (points(i, k) - 2) * (points(i, k) - 2);
      options.weights.push_back(squared - 1);
    }
    const Alpha alpha(points, options);
    alpha.for_each_cell(0, [&](const auto& v) {
      std::vector<Index> point;
      alpha.append_input_cell(0, v, point);
      const double alone = -options.weights[static_cast<std::size_t>(point[0])];
      late += alpha.value(v) > alone ? 1 : 0;
    });
    EXPECT_EQ(first_difference(persistence(alpha), persistence(alpha, {.engine = Engine::twist})),
              "");
  });
  EXPECT_TRUE(is_enough(late, 100)) << late;
}

// Edges and vertices that enter late have equal values up to rounding.
TEST(AlphaAdverse, WeightedDecimals) {
  for_each_seed(60, [&](Generator& random, bool, std::int64_t) {
    Points points(12, 3);
    for (double& x : points.coordinates()) x = 0.1 * random.integer(0, 4);
    AlphaOptions options{.unit = AlphaOptions::Unit::squared};
    for (int i = 0; i < 12; ++i) options.weights.push_back(0.01 * random.integer(0, 4));
    const Alpha alpha(points, options);
    EXPECT_EQ(first_difference(persistence(alpha), persistence(alpha, {.engine = Engine::twist})),
              "");
  });
}

// Squares of distances underflow here, or are tiny compared to the weights.
TEST(AlphaAdverse, PointsThatAreCloseBesideTheirWeights) {
  for (const double distance : {1e-9, 1e-155, 1e-170, 1e-305}) {
    const Points points{{0, 0, 0}, {distance, 0, 0}, {0, distance, 0}, {0, 0, distance}};
    const Alpha alpha(points, {.weights = {1, 1, 1, 1}, .unit = AlphaOptions::Unit::squared});
    EXPECT_EQ(alpha.simplex_counts(), (std::vector<std::size_t>{4, 6, 4, 1}));
    for (int dim = 0; dim <= 3; ++dim)
      alpha.for_each_cell(dim,
                          [&](const auto& cell) { EXPECT_NEAR(alpha.value(cell), -1, 1e-15); });
  }
}

TEST(AlphaAdverse, ExtremeMagnitudes) {
  for (const double unit : {1e150, 1e-150, 1e300, 1e-290}) {
    const Points points = times(uniform_points(60, 3, 2), unit);
    const Barcode bars = persistence(Alpha(points)),
                  of_ones = persistence(Alpha(times(points, 1 / unit)));
    ASSERT_EQ(bars.size(), of_ones.size());
    for (std::size_t i = 0; i < bars.size(); ++i)
      EXPECT_NEAR(bars[i].birth / unit, of_ones[i].birth, 1e-12);
  }
  expect_error(ErrorKind::bad_data, "magnitudes", [] {
    Alpha(Points{{1e300, 0, 0}, {1e-300, 0, 0}});
  });
}

}  // namespace
}  // namespace ph::test
