// SPDX-License-Identifier: MIT
// Tests the promises of greedy permutations, distances to a measure, and sparse Rips filtrations.
#include <limits>
#include <numeric>

#include "ph/detail/rips/sparse_rips.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/eigen.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/matching.hpp"
#include "tests/support/points.hpp"
#include "tests/support/rips_graphs.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr PointDistance kMetrics[] = {PointDistance::euclidean, PointDistance::manhattan,
                                      PointDistance::chebyshev, PointDistance::hamming};

/// Points with ties, copies or clusters.
Points random_points(Generator& random, Index most, bool ties) {
  Points points =
      random.points(random.integer(1, static_cast<int>(most)), random.integer(1, 3), ties);
  for (Index i = 1; i < points.rows(); ++i) {
    const int kind = random.integer(0, 9);
    const Index other = random.integer(0, static_cast<int>(i) - 1);
    if (kind == 0) copy_point(points, other, points, i);
    if (kind == 1)
      as_matrix(points).row(i) = as_matrix(points).row(other) + as_matrix(points).row(i) / 64;
  }
  return points;
}

DistanceMatrix matrix_of(const PointMetric& metric) {
  std::vector<double> lower;
  for (Index i = 0; i < metric.size(); ++i)
    for (Index j = 0; j < i; ++j) lower.push_back(metric(i, j));
  return DistanceMatrix(metric.size(), lower);
}

/// The greedy permutation, computed by its definition from all distances.
template <Metric M>
GreedyPermutation greedy_by_definition(const M& metric, const GreedyLimits& limits) {
  GreedyPermutation result;
  const Index n = metric.size();
  if (n == 0) return result;
  Index next = 0;
  double radius = kInf;
  do {
    result.points.push_back(static_cast<std::uint32_t>(next));
    result.radii.push_back(radius);
    radius = -1;
    for (Index i = 0; i < n; ++i) {
      double nearest = kInf;
      for (const std::uint32_t p : result.points) nearest = std::min<double>(nearest, metric(i, p));
      if (nearest > radius) {
        radius = nearest;
        next = i;
      }
    }
  } while (radius > limits.radius && static_cast<Index>(result.points.size()) < limits.points);
  result.covering_radius = radius;
  return result;
}

TEST(GreedyPermutations, AreWhatTheyAreByDefinition) {
  for_each_seed(4000, [](Generator& random, bool ties, std::int64_t) {
    Points points = random_points(random, 24, ties);
    if (random.integer(0, 3) == 0)
      scale(points.coordinates(), std::ldexp(1, random.coin() ? 1000 : -1070));
    const PointDistance distance = kMetrics[random.integer(0, 3)];
    const PointMetric metric(points, distance);
    GreedyLimits limits;
    if (random.coin()) limits.points = random.integer(1, 30);
    if (random.coin()) limits.radius = random.value(ties);
    const GreedyPermutation expected = greedy_by_definition(metric, limits);
    const GreedyPermutation of_points = greedy_permutation(points, limits, distance);
    const GreedyPermutation of_matrix = greedy_permutation(matrix_of(metric), limits);
    for (const GreedyPermutation* found : {&of_points, &of_matrix}) {
      EXPECT_EQ(found->points, expected.points);
      EXPECT_EQ(found->radii, expected.radii);
      EXPECT_EQ(found->covering_radius, expected.covering_radius);
    }
    EXPECT_TRUE(std::ranges::is_sorted(of_points.radii, std::greater()));
  });
}

// The code processes blocks of 512 points. There are one to four blocks, of which the last may be
// incomplete.
TEST(GreedyPermutations, OfManyPoints) {
  Generator random(3);
  for (const Index n : {511, 512, 513, 2000}) {
    const Points points = random.points(n, 3, false);
    const PointMetric metric(points);
    const GreedyPermutation fast = greedy_permutation(points, {.points = 60});
    const GreedyPermutation slow = greedy_permutation(metric, {.points = 60});
    EXPECT_EQ(fast.points, slow.points);
    EXPECT_EQ(fast.radii, slow.radii);
    EXPECT_EQ(fast.covering_radius, slow.covering_radius);
  }
}

TEST(GreedyPermutations, OfFewPointsAndBadLimits) {
  EXPECT_TRUE(greedy_permutation(Points(0, 2)).points.empty());
  EXPECT_EQ(greedy_permutation(Points(0, 2)).covering_radius, 0);
  const Points copies = to_points(PointMatrix::Ones(5, 2));
  EXPECT_EQ(greedy_permutation(copies).points, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(greedy_permutation(copies).covering_radius, 0);
  // Two distances are equal although their squares differ.
  const Points equal{{0, 0}, {1, 0}, {1, std::ldexp(1, -26)}};
  EXPECT_EQ(greedy_permutation(equal).points, (std::vector<std::uint32_t>{0, 1, 2}));
  const DistanceMatrix apart(3, {kInf, 1, kInf});
  EXPECT_EQ(greedy_permutation(apart).radii, (std::vector<double>{kInf, kInf, 1}));
  EXPECT_EQ(greedy_permutation(apart, {.points = 1}).covering_radius, kInf);
  expect_error(ErrorKind::usage, "at least 1", [&] { greedy_permutation(copies, {.points = 0}); });
  expect_error(ErrorKind::usage, "at least 1",
               [&] { greedy_permutation(copies, {.radius = kNan}); });
  StoppedContext context;
  Generator random(1);
  const Points many = random.points(5000, 2, false);
  for (const PointDistance distance : {PointDistance::euclidean, PointDistance::manhattan})
    expect_error(ErrorKind::cancelled, "",
                 [&] { greedy_permutation(many, {}, distance, 2, context); });
}

TEST(Subsamples, KeepWhatTheyPromise) {
  for_each_seed(20000, [](Generator& random, bool ties, std::int64_t field) {
    const int max_dim = random.integer(0, 2);
    const Points points = random_points(random, max_dim == 2 ? 9 : 11, ties);
    const GreedyPermutation sample =
        greedy_permutation(points, {.points = random.integer(1, static_cast<int>(points.rows()))});
    const std::vector<std::uint32_t> vertices = sample.ascending();
    const Options options{.max_dim = max_dim, .field = field};
    const Barcode all = persistence(Rips(points), options),
                  some = persistence(Rips(points, {.vertices = vertices}), options);
    for (int dim = 0; dim <= max_dim; ++dim)
      EXPECT_EQ(late_matching_fault(all, some, dim,
                                    [&](double x) { return x + 2 * sample.covering_radius; }),
                "");
    for (std::size_t i = 0; i < some.size(); ++i)
      for (const Index v : some.birth_cell(i).numbers)
        EXPECT_TRUE(std::ranges::binary_search(vertices, v)) << "cells name points of the input";
  });
}

TEST(SparseRipsFiltrations, KeepWhatTheyPromise) {
  std::size_t fewer = 0;
  for_each_seed(20000, [&](Generator& random, bool ties, std::int64_t field) {
    const int max_dim = random.integer(0, 2);
    const Points points = random_points(random, max_dim == 2 ? 10 : 12, ties);
    const double epsilon = std::ldexp(1 + random.real(), random.integer(-4, 4));
    const PointDistance distance = kMetrics[random.integer(0, 3)];
    const Options options{.max_dim = max_dim, .field = field};
    const Rips exact(points, {
                                 .distance = distance,
                             });
    const RipsOptions sparse_options{.distance = distance, .approximation = epsilon};
    const Rips sparse = random.coin()
                            ? Rips(points, sparse_options)
                            : Rips(matrix_of(PointMetric(points, distance)), sparse_options);
    const Barcode early = persistence(exact, options), late = persistence(sparse, options);
    for (int dim = 0; dim <= max_dim; ++dim)
      EXPECT_EQ(late_matching_fault(early, late, dim, [&](double x) { return x * (1 + epsilon); }),
                "")
          << "epsilon " << epsilon;
    fewer += all_edges(sparse).edge_count() < all_edges(exact).edge_count() ? 1 : 0;
  });
  EXPECT_TRUE(is_enough(fewer, std::size_t{5000})) << fewer;  // the test covers enough cases
}

// Computes the edges by the definition. The balls of two points grow up to a largest diameter each.
// The value of an edge is the value at which its two balls meet. If the balls would meet too late,
// there is no edge.
TEST(SparseRipsFiltrations, HaveTheEdgesThatTheySay) {
  std::size_t missing = 0, late = 0;
  for_each_seed(500, [&](Generator& random, bool ties, std::int64_t) {
    Points points = random_points(random, 24, ties);
    for (Index i = 0; i < points.rows(); ++i)
      scale(points.row(i), std::ldexp(1, -random.integer(0, 9)));
    const double epsilon = 0.1 + random.real();
    const PointMetric metric(points);
    const GreedyPermutation order = greedy_permutation(points);
    std::vector<double> largest(static_cast<std::size_t>(points.rows()), 0);
    for (std::size_t k = 0; k < order.points.size(); ++k)
      largest[order.points[k]] = 2 * order.radii[k] * (1 + epsilon) / epsilon;
    const Rips sparse(points, {.threshold = kInf, .approximation = epsilon});
    const RipsGraph& graph = all_edges(sparse);
    for (std::uint32_t u = 0; u < points.rows(); ++u) {
      for (std::uint32_t v = 0; v < u; ++v) {
        const double d = metric(u, v), last = (1 + epsilon) * std::min(largest[u], largest[v]);
        const auto meet_at = [&](double t) {
          return std::min(t, largest[u]) / 2 + std::min(t, largest[v]) / 2 >= d;
        };
        const auto key = graph.adjacency().key_of(u, v);
        if (key == RipsAdjacency::kNever) {
          EXPECT_FALSE(d > 0 && meet_at(last * (1 - 1e-9)));
          ++missing;
          continue;
        }
        const double value = graph.value(key);
        EXPECT_TRUE(meet_at(value * (1 + 1e-9)));
        EXPECT_FALSE(d > 0 && meet_at(value * (1 - 1e-9)));
        EXPECT_LE(value, last * (1 + 1e-9));
        late += value > d ? 1 : 0;
      }
    }
  });
  EXPECT_TRUE(is_enough(missing, std::size_t{1000})) << missing;
  EXPECT_TRUE(is_enough(late, std::size_t{1000})) << late;
}

// The points lie on many scales, so edges are left out.
TEST(SparseRipsFiltrations, KeepWhatTheyPromiseOnManyScales) {
  for_each_seed(150, [](Generator& random, bool, std::int64_t field) {
    Points points = random.points(random.integer(20, 50), 2, false);
    for (Index i = 0; i < points.rows(); ++i)
      scale(points.row(i), std::ldexp(1, -random.integer(0, 9)));
    const double epsilon = std::ldexp(1 + random.real(), random.integer(-3, 1));
    const Options options{.max_dim = 1, .field = field};
    const Barcode early = persistence(Rips(points), options),
                  late = persistence(Rips(points, {.approximation = epsilon}), options);
    for (const int dim : {0, 1})
      EXPECT_EQ(late_matching_fault(early, late, dim, [&](double x) { return x * (1 + epsilon); }),
                "");
  });
}

TEST(SparseRipsFiltrations, AreExactForASmallEpsilon) {
  for_each_seed(2000, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random_points(random, 10, ties);
    const Options options{.max_dim = 2, .field = field};
    RipsOptions sparse{.approximation = random.coin() ? 1e-300 : 1e-9};
    if (random.coin()) sparse.threshold = 1.5;
    EXPECT_EQ(bars_of(persistence(Rips(points, sparse), options)),
              bars_of(persistence(Rips(points, {.threshold = sparse.threshold}), options)));
  });
}

TEST(SparseRipsFiltrations, HaveFewEdges) {
  Generator random(5);
  const Points points = random.points(3000, 2, false);
  const std::size_t one = all_edges(Rips(points, {.approximation = 1})).edge_count();
  EXPECT_LT(one, 3000U * 2999 / 2 / 10);
  EXPECT_GT(one, all_edges(Rips(points, {.approximation = 2})).edge_count());
}

TEST(SparseRipsFiltrations, PassTheSuite) {
  for_each_seed(1000, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random_points(random, 10, ties);
    check(Rips(points, {.approximation = 2 * random.real() + 0.01}), random.integer(0, 2), {field});
  });
}

TEST(SparseRipsFiltrations, RefuseWhatMakesNoSense) {
  const Points points = to_points(PointMatrix::Random(4, 2));
  for (const double bad : {0.0, -1.0, kNan, kInf})
    expect_error(ErrorKind::usage, "epsilon", [&] { Rips(points, {.approximation = bad}); });
  const std::vector<double> births(4, 1.0);
  expect_error(ErrorKind::usage, "births",
               [&] { Rips(points, {.births = births, .approximation = 1}); });
  expect_error(ErrorKind::usage, "spanning forest",
               [&] { Rips(points, {.approximation = 1}).graph(RipsForm::forest); });
  expect_error(ErrorKind::usage, "all distances",
               [&] { Rips(SparseDistances(2, {}), {.approximation = 1}); });
  EXPECT_EQ(Rips(Points(0, 2), {.approximation = 1}).size(), 0);
  EXPECT_EQ(persistence(Rips(Points(1, 2), {.approximation = 1})).size(), 1U);
}

TEST(DistanceToMeasure, IsWhatItIsByDefinition) {
  for_each_seed(2000, [](Generator& random, bool ties, std::int64_t) {
    const Points points = random_points(random, random.integer(0, 9) == 0 ? 300 : 20, ties);
    const PointDistance distance = kMetrics[random.integer(0, 3)];
    const PointMetric metric(points, distance);
    const Index n = points.rows(), k = random.integer(1, static_cast<int>(n));
    const std::vector<double> found = distance_to_measure(points, k, distance);
    EXPECT_EQ(distance_to_measure(metric, k), found);
    for (Index i = 0; i < n; ++i) {
      std::vector<double> distances;
      for (Index j = 0; j < n; ++j) distances.push_back(metric(i, j));
      std::ranges::sort(distances);
      double sum = 0;
      for (Index j = 0; j < k; ++j) sum += std::pow(distances[static_cast<std::size_t>(j)], 2);
      EXPECT_NEAR(found[static_cast<std::size_t>(i)], std::sqrt(sum / static_cast<double>(k)),
                  1e-12);
    }
  });
}

TEST(DistanceToMeasure, OfLargeAndSmallPointsAndBadNumbers) {
  Points line{{0}, {3}, {4}};
  EXPECT_EQ(distance_to_measure(line, 1), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(distance_to_measure(line, 2)[1], std::sqrt(0.5));
  scale(line.coordinates(), 1e200);
  EXPECT_DOUBLE_EQ(distance_to_measure(line, 3)[0], 1e200 * std::sqrt(25.0 / 3));
  for (const Index bad : {-1, 0, 4})
    expect_error(ErrorKind::usage, "neighbours", [&] { distance_to_measure(line, bad); });
  EXPECT_EQ(distance_to_measure(DistanceMatrix(2, {kInf}), 2)[0], kInf);
}

TEST(CoreDistances, AreWhatTheyAreByDefinition) {
  for_each_seed(500, [](Generator& random, bool ties, std::int64_t) {
    const Points points = random_points(random, random.integer(0, 9) == 0 ? 600 : 20, ties);
    const PointDistance distance = kMetrics[random.integer(0, 3)];
    const PointMetric metric(points, distance);
    const Index n = points.rows(), k = random.integer(0, static_cast<int>(n) - 1);
    const std::vector<double> found = core_distances(points, k, distance);
    EXPECT_EQ(core_distances(metric, k), found);
    for (Index i = 0; i < n; ++i) {
      std::vector<double> distances{0};
      for (Index j = 0; j < n; ++j)
        if (j != i) distances.push_back(metric(i, j));
      std::sort(distances.begin() + 1, distances.end());
      EXPECT_EQ(found[static_cast<std::size_t>(i)], distances[static_cast<std::size_t>(k)]);
    }
  });
}

TEST(CoreDistances, OfManyAxes) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    Points points = random.points(random.integer(1, 90), random.integer(9, 14), ties);
    if (random.integer(0, 4) == 0) points = scaled(points, std::ldexp(1, -520));
    const PointMetric metric(points);
    const Index n = points.rows(), k = random.integer(0, static_cast<int>(n) - 1);
    EXPECT_EQ(core_distances(points, k), core_distances(metric, k));
    if (k > 0) {
      EXPECT_EQ(distance_to_measure(points, k), distance_to_measure(metric, k));
    }
  });
}

TEST(CoreDistances, CopiesCountAndBadNumbersAreRefused) {
  const Points line{{0}, {0}, {0}, {3}, {4}};
  EXPECT_EQ(core_distances(line, 2), (std::vector<double>{0, 0, 0, 3, 4}));
  EXPECT_EQ(core_distances(line, 4), (std::vector<double>{4, 4, 4, 3, 4}));
  EXPECT_EQ(core_distances(Points(0, 2), 0).size(), 0U);
  EXPECT_EQ(core_distances(DistanceMatrix(2, {kInf}), 1)[0], kInf);
  for (const Index bad : {-1, 5})
    expect_error(ErrorKind::usage, "number of other points, 4", [&] { core_distances(line, bad); });
  expect_error(ErrorKind::usage, "one of them",
               [&] { Rips(line, {.dtm_neighbours = 2, .core_neighbours = 2}); });
  expect_error(ErrorKind::usage, "core distances",
               [&] { Rips(SparseDistances(2, {}), {.core_neighbours = 1}); });
  expect_error(ErrorKind::bad_data, "finite", [&] { core_distances(Points{{kInf}, {0}}, 0); });
}

// The mutual reachability distances of HDBSCAN*, without halves.
TEST(CoreDistances, AreTheBirthsOfARipsFiltration) {
  const Points line{{0}, {1}, {3}, {10}};
  const MergeTree tree = merge_tree(Rips(line, {.core_neighbours = 2}));
  EXPECT_EQ(tree.births, (std::vector<double>{3, 2, 3, 9}));
  std::vector<double> values;
  for (const Merge& m : tree.merges) values.push_back(m.value);
  EXPECT_EQ(values, (std::vector<double>{3, 3, 9}));
}

// An outlier lies between two dense groups. Without weights, it would be a separate component.
TEST(DistanceToMeasure, OutliersComeLate) {
  Points points(41, 2);
  for (Index i = 0; i < 40; ++i)
    points.set_row(i, {(i < 20 ? 0.0 : 10.0) + 0.01 * double(i % 20), 0});
  points.set_row(40, {5, 0});
  std::vector<double> births = distance_to_measure(points, 5);
  for (double& b : births) b *= 2;
  const Barcode bars = persistence(
      Rips(points, {.births = births, .weight_exponent = WeightExponent::one}), {.max_dim = 0});
  // The outlier joins a component at its birth or soon after. Only the two groups have long bars.
  std::size_t long_bars = 0;
  for (const Bar& bar : bars) long_bars += bar.persistence() > 1 ? 1 : 0;
  EXPECT_EQ(long_bars, 2U);
}

}  // namespace
}  // namespace ph::test
