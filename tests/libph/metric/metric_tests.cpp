// SPDX-License-Identifier: MIT
// Compares distances with values computed by hand, even at the limits of the range of doubles.
// Compares searches for near pairs with lists of all pairs.
#include <limits>
#include <numeric>

#include "libph/src/metric/neighbour_search.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/metric/pairs_within.hpp"
#include "ph/detail/metric/row_distances.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/eigen.hpp"
#include "ph/sparse_distances.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/points.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Points rows(std::initializer_list<std::initializer_list<double>> list) {
  Points p(static_cast<Index>(list.size()), static_cast<Index>(list.begin()->size()));
  Index i = 0;
  for (const auto& row : list) {
    Index k = 0;
    for (const double x : row) p(i, k++) = x;
    ++i;
  }
  return p;
}

double distance(PointDistance name, std::initializer_list<double> a,
                std::initializer_list<double> b, double p = 2) {
  const Points points = rows({a, b});
  const PointMetric metric(points, name, p);
  EXPECT_EQ(metric(0, 1), metric(1, 0));
  EXPECT_EQ(metric(0, 0), 0);
  return metric(0, 1);
}

TEST(DistanceMatrices, HoldTheLowerTriangleRowByRow) {
  const DistanceMatrix d(4, {1, 2, 3, 4, 5, kInf});
  EXPECT_EQ(d.size(), 4);
  EXPECT_EQ(d(1, 0), 1);
  EXPECT_EQ(d(2, 0), 2);
  EXPECT_EQ(d(2, 1), 3);
  EXPECT_EQ(d(3, 0), 4);
  EXPECT_EQ(d(1, 3), 5);
  EXPECT_EQ(d(2, 3), kInf);
  for (Index i = 0; i < 4; ++i) EXPECT_EQ(d(i, i), 0);
  EXPECT_FALSE(std::signbit(DistanceMatrix(2, {-0.0})(0, 1)));
  EXPECT_EQ(DistanceMatrix(0, {}).size(), 0);
  EXPECT_EQ(DistanceMatrix(1, {}).size(), 1);
}

TEST(DistanceMatrices, RefuseWhatIsNoDistance) {
  expect_error(ErrorKind::bad_data, "expected 3", [] { DistanceMatrix(3, {1, 2}); });
  expect_error(ErrorKind::bad_data, "expected 0", [] { DistanceMatrix(1, {1}); });
  expect_error(ErrorKind::bad_data, "-1 points", [] { DistanceMatrix(-1, {}); });
  expect_error(ErrorKind::bad_data, "(2, 1): found nan", [] { DistanceMatrix(3, {1, 2, kNan}); });
  expect_error(ErrorKind::bad_data, "(2, 0): found -1", [] { DistanceMatrix(3, {1, -1, 2}); });
  expect_error(ErrorKind::bad_data, "(1, 0): found -inf", [] { DistanceMatrix(2, {-kInf}); });
}

TEST(PointMetrics, ByHand) {
  using enum PointDistance;
  EXPECT_EQ(distance(euclidean, {0, 0}, {3, 4}), 5);
  EXPECT_EQ(distance(manhattan, {0, 0}, {3, -4}), 7);
  EXPECT_EQ(distance(chebyshev, {0, 0}, {3, -4}), 4);
  EXPECT_NEAR(distance(minkowski, {0, 0}, {3, 4}, 3), std::cbrt(91), 1e-14);
  EXPECT_NEAR(distance(minkowski, {0, 0}, {3, 4}, 1), 7, 1e-14);
  EXPECT_NEAR(distance(minkowski, {0, 0}, {3, 4}, kInf), 4, 1e-14);
  EXPECT_EQ(distance(minkowski, {1, 2}, {1, 2}, 3), 0);
  EXPECT_NEAR(distance(cosine, {1, 0}, {0, 7}), 1, 1e-15);
  EXPECT_NEAR(distance(cosine, {1, 0}, {-3, 0}), 2, 1e-15);
  EXPECT_EQ(distance(cosine, {1, 0}, {5, 0}), 0);
  EXPECT_NEAR(distance(cosine, {1, 0}, {1, 1}), 1 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(distance(cosine, {1, 0}, {1, 1e-9}) / 5e-19, 1, 1e-12) << "small angles keep digits";
  EXPECT_EQ(distance(hamming, {1, 2, 3, 4}, {1, 0, 3, 0}), 2);
  EXPECT_EQ(distance(hamming, {0.0}, {-0.0}), 0);
}

TEST(PointMetrics, NoCoordinatesNoDistance) {
  using enum PointDistance;
  const Points points(3, 0);
  for (const PointDistance name : {euclidean, manhattan, chebyshev, minkowski, hamming})
    EXPECT_EQ(PointMetric(points, name)(0, 2), 0);
}

TEST(PointMetrics, TheEndsOfTheRangeOfDouble) {
  using enum PointDistance;
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  EXPECT_NEAR(distance(euclidean, {0, 0}, {3e-300, 4e-300}) / 5e-300, 1, 1e-15);
  EXPECT_NEAR(distance(euclidean, {0, 0}, {3e300, -4e300}) / 5e300, 1, 1e-15);
  EXPECT_NEAR(distance(euclidean, {1e300, 1}, {-1e300, 1}) / 2e300, 1, 1e-15);
  EXPECT_NEAR(distance(euclidean, {1, 1}, {1, 1 + 1e-15}) / (1 + 1e-15 - 1), 1, 1e-15);
  EXPECT_NEAR(distance(euclidean, {1e-200, 0}, {0, 1}), 1, 1e-15);
  EXPECT_EQ(distance(euclidean, {0}, {kTiny}), kTiny) << "denormals are kept";
  EXPECT_EQ(distance(euclidean, {-kTiny}, {kTiny}), 2 * kTiny);
  EXPECT_EQ(distance(euclidean, {3 * kTiny, 0}, {0, 4 * kTiny}), 5 * kTiny);
  for (const PointDistance name : {manhattan, chebyshev}) {
    EXPECT_EQ(distance(name, {0}, {kTiny}), kTiny);
    EXPECT_EQ(distance(name, {0}, {1e300}), 1e300);
  }
  EXPECT_NEAR(distance(minkowski, {0, 0}, {3e300, 4e300}, 2) / 5e300, 1, 1e-14);
  EXPECT_NEAR(distance(minkowski, {0, 0}, {3e-300, 4e-300}, 2) / 5e-300, 1, 1e-14);
  EXPECT_NEAR(distance(cosine, {1e-300, 0}, {1e300, 1e300}), 1 - std::sqrt(0.5), 1e-15);
}

TEST(PointMetrics, KeptDirectionsChangeNothingAndAreCounted) {
  const Points points = rows({{1, 2, 3, 4, 5},
                              {-2, 1, 0.1, 7, 1e-9},
                              {3e200, 1, 0, 0, 1e199},
                              {1e-300, 2e-300, 0, 0, 0},
                              {0.3, 0.6, 0.9, 1.2, 1.5}});
  const PointMetric plain(points, PointDistance::cosine);
  RunContext context;
  {
    PointMetric kept(points, PointDistance::cosine);
    kept.keep_directions(context);
    EXPECT_EQ(context.memory.used(), 25 * sizeof(double));
    const PointMetric copy = kept;
    for (Index i = 0; i < points.rows(); ++i)
      for (Index j = 0; j < points.rows(); ++j) EXPECT_EQ(copy(i, j), plain(i, j)) << i << ' ' << j;
  }
  EXPECT_EQ(context.memory.used(), 0U);
  PointMetric euclidean(points);
  euclidean.keep_directions(context);
  EXPECT_EQ(context.memory.used(), 0U) << "only cosine has directions";
}

TEST(PointMetrics, RefuseWhatTheyCannotMeasure) {
  using enum PointDistance;
  for (const PointDistance name : {euclidean, manhattan, chebyshev, minkowski})
    expect_error(ErrorKind::bad_data, "the largest double", [name] {
      distance(name, {1.7e308, 1.7e308}, {-1.7e308, -1.7e308});
    });
  EXPECT_NEAR(distance(euclidean, {0.8e308}, {-0.8e308}) / 1.6e308, 1, 1e-15);
  expect_error(ErrorKind::bad_data, "point 1, coordinate 0: found nan",
               [] { distance(euclidean, {0}, {kNan}); });
  expect_error(ErrorKind::bad_data, "point 0, coordinate 1: found -inf", [] {
    distance(hamming, {0, -kInf}, {0, 0});
  });
  expect_error(ErrorKind::bad_data, "point 1", [] { distance(cosine, {1, 0}, {0, 0}); });
  for (const double p : {0.5, 0.0, -1.0, kNan})
    expect_error(ErrorKind::usage, "exponent", [p] { distance(minkowski, {0}, {1}, p); });
}

TEST(SparseDistanceSets, KeepEachEdgeOnce) {
  const SparseDistances s(4, {{3, 1, 2}, {0, 2, -0.0}, {0, 1, kInf}});
  EXPECT_EQ(s.size(), 4);
  EXPECT_EQ(s.edges(), (std::vector<WeightedEdge>{{0, 1, kInf}, {0, 2, 0}, {1, 3, 2}}));
  EXPECT_FALSE(std::signbit(s.edges()[1].value));
  EXPECT_EQ(SparseDistances(0, {}).size(), 0);
}

TEST(SparseDistanceSets, RefuseWhatIsNoEdge) {
  const auto refuse = [](WeightedEdge e, const std::string& what) {
    expect_error(ErrorKind::bad_data, what, [e] { SparseDistances(3, {{0, 1, 1}, e}); });
  };
  refuse({1, 1, 0}, "(1, 1)");
  refuse({-1, 2, 0}, "(-1, 2)");
  refuse({2, 3, 0}, "(2, 3)");
  refuse({INT64_MAX, 0, 0}, "below 3");
  refuse({0, 2, -1}, "found distance -1");
  refuse({0, 2, kNan}, "found distance nan");
  refuse({1, 0, 5}, "(0, 1) occurs twice");
  refuse({0, 1, 1}, "(0, 1) occurs twice");
}

std::vector<WeightedEdge> all_pairs_within(const PointMetric& metric, double radius) {
  std::vector<WeightedEdge> edges;
  for (Index i = 0; i < metric.size(); ++i)
    for (Index j = i + 1; j < metric.size(); ++j)
      if (metric(i, j) <= radius) edges.push_back({i, j, metric(i, j)});
  return edges;
}
std::vector<WeightedEdge> all_pairs_within(const Points& points, double radius) {
  return all_pairs_within(PointMetric(points), radius);
}

TEST(SparseDistanceSets, NearPairsAreThoseOfAllPairs) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    Generator random(seed);
    const Index n = random.integer(0, 60), d = random.integer(1, 6);
    Points points = random.points(n, d, random.coin());
    const double units[] = {1, 1, 1e-3, 1e100, 1e200, 1e307, 1e-200, 1e-310};
    scale(points.coordinates(), units[random.integer(0, 7)]);
    double radius = 0;
    // If the radius equals a distance to the last bit, the pair is included.
    if (n >= 2 && random.integer(0, 3) != 0)
      radius = PointMetric(points)(random.integer(0, static_cast<int>(n) - 1), 0);
    EXPECT_EQ(SparseDistances::within(points, radius).edges(), all_pairs_within(points, radius))
        << "seed " << seed;
    const double below = std::nextafter(radius, 0.0), above = std::nextafter(radius, kInf);
    EXPECT_EQ(SparseDistances::within(points, below).edges(), all_pairs_within(points, below));
    EXPECT_EQ(SparseDistances::within(points, above).edges(), all_pairs_within(points, above));
  }
}

// Tests the tree directly, because for_each_pair_within uses the tree only for larger numbers of
// points.
TEST(NearPairsOfATree, AreThoseOfAllPairs) {
  constexpr PointDistance distances[] = {PointDistance::euclidean, PointDistance::manhattan,
                                         PointDistance::chebyshev, PointDistance::minkowski};
  for_each_seed(800, [&](Generator& random, bool ties, std::int64_t) {
    const int n = random.integer(1, 60);
    Points points = random.points(n, random.integer(1, 13), ties);
    const double units[] = {1, 1, 1e-3, 1e100, 1e200, 1e306, 1e-200, 1e-310};
    scale(points.coordinates(), units[random.integer(0, 7)]);
    const PointDistance distance = distances[random.integer(0, 3)];
    // Compared with the coordinate of one ordinary point, the powers of tiny distances are 0.
    if (distance != PointDistance::minkowski && random.coin()) points(0, 0) = 1;
    const double p = 1 + 3 * random.real();
    const PointMetric given(points, distance, p);
    std::vector<std::uint32_t> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0U);
    const KdTree tree(points, all, default_context());
    const PointMetric metric(tree.points(), distance, p);
    const auto search =
        NeighbourSearch::make(tree, metric, distance, p, nullptr, default_context());
    const double inclusive = given(random.integer(0, n - 1), 0);
    for (const double radius : {inclusive, std::nextafter(inclusive, 0.0), kInf}) {
      std::vector<WeightedEdge> edges;
      search->pairs_within(
          radius,
          [&](Index i, Index j, double d) {
            EXPECT_LT(i, j);
            edges.push_back({i, j, d});
          },
          default_context());
      EXPECT_EQ(SparseDistances(n, edges).edges(), all_pairs_within(given, radius));
    }
  });
}

// Far from the origin, coordinates have few digits after the decimal point.
TEST(SparseDistanceSets, NearPairsFarFromTheOrigin) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Generator random(seed);
    const double far = std::ldexp(1 + random.real(), random.integer(10, 50));
    Points points(40, random.integer(1, 3));
    for (double& x : points.coordinates()) x = far + random.integer(-12, 12) * 0.25;
    for (const double radius : {0.25, 0.5, 1.0, 3.0})
      ASSERT_EQ(SparseDistances::within(points, radius).edges(), all_pairs_within(points, radius))
          << "seed " << seed << " radius " << radius;
  }
}

// In units of the radius, these coordinates lie around a power of two, where the spacing of doubles
// changes.
TEST(SparseDistanceSets, NearPairsAtAStepOfRounding) {
  const double radius = 0.8575754491187267;
  const Points pair = rows({{230203656.9687939}, {230203657.82636935}});
  EXPECT_EQ(SparseDistances::within(pair, radius).edges().size(), 1U);
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Generator random(seed);
    const double r = 0.5 + random.real() / 2;
    const double middle = std::ldexp(r * (1 + 1e-9), random.integer(20, 29));
    Points points{{middle - random.real() * 1e-7}, {0}};
    points(1, 0) = points(0, 0) + r;
    ASSERT_EQ(SparseDistances::within(points, r).edges(), all_pairs_within(points, r)) << seed;
  }
}

TEST(SparseDistanceSets, RadiiAtTheEnds) {
  const Points points = rows({{0, 0}, {3, 4}, {0, 0}, {1e300, 0}});
  EXPECT_EQ(SparseDistances::within(points, 0).edges(), (std::vector<WeightedEdge>{{0, 2, 0}}));
  EXPECT_EQ(SparseDistances::within(points, 5).edges().size(), 3U);
  EXPECT_EQ(SparseDistances::within(points, kInf).edges().size(), 6U);
  EXPECT_EQ(SparseDistances::within(Points(3, 0), 0).edges().size(), 3U);
  EXPECT_EQ(SparseDistances::within(Points(0, 2), 1).size(), 0);
  expect_error(ErrorKind::usage, "radius", [&] { SparseDistances::within(points, -1); });
  expect_error(ErrorKind::usage, "radius", [&] { SparseDistances::within(points, kNan); });
}

// A list of all pairs would have 5 * 10^9 distances.
TEST(SparseDistanceSets, ManyPointsAndFewPairsTakeNearLinearTime) {
  for (const Index d : {2, 4}) {
    Points line = to_points(PointMatrix::Constant(100000, d, 7));
    for (Index i = 0; i < line.rows(); ++i) line(i, 0) = static_cast<double>(i / 2);
    for (const double unit : {1.0, 1e-303, 1e303}) {
      const Points points = scaled(line, unit);
      for (const double radius : {0.0, 1e-300 * unit, 0.5 * unit})
        EXPECT_EQ(SparseDistances::within(points, radius).edges().size(), 50000U) << unit;
    }
  }
}

TEST(SparseDistanceSets, TheSearchStopsOnRequest) {
  StoppedContext context;
  Generator random(1);
  for (const auto& [n, d] : {std::pair(1000, 2), std::pair(1000, 5), std::pair(20000, 5)}) {
    const Points points = random.points(n, d, false);
    expect_error(ErrorKind::cancelled, "", [&] {
      for_each_pair_within(
          points, 0.5, [](Index, Index, double) {}, context);
    });
  }
}

// A distance in a row equals the single distance bit for bit. Otherwise the method of computation
// would decide ties.
TEST(RowDistancesOf, APointMetricAreItsDistances) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const Index n = random.integer(0, 70);
    Points points = random.points(n, random.integer(0, 5), ties);
    const double units[] = {1, 1, 1e-150, 1e-141, 1e120, 1e160};
    scale(points.coordinates(), units[random.integer(0, 5)]);
    const PointMetric metric(points,
                             random.coin() ? PointDistance::euclidean : PointDistance::manhattan);
    const RowDistances<PointMetric> rows(metric, std::pmr::new_delete_resource());
    std::vector<double> row(static_cast<std::size_t>(rows.row_capacity()));
    for (Index i = 0; i < n; ++i) {
      rows(i, row.data());
      for (Index j = 0; j < i; ++j)
        ASSERT_EQ(row[static_cast<std::size_t>(j)], metric(i, j)) << i << " " << j;
    }
  });
}

}  // namespace
}  // namespace ph::test
