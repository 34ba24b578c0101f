// SPDX-License-Identifier: MIT
// Spanning forests give H0 without the graph of all edges. The tests compare them with the oracle
// on the whole filtration.
#include <algorithm>
#include <limits>

#include "ph/distance_to_measure.hpp"
#include "ph/eigen.hpp"
#include "ph/estimate.hpp"
#include "ph/merge_tree.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"
#include "tests/support/rips_graphs.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;

/// The pairs computed from one form of the filtration, including pairs of length 0.
std::vector<Pair> components_of(const Rips& rips, RipsForm form, Engine engine,
                                const RunContext& context = default_context()) {
  return with_rips_filtration(rips.graph(form, context), 0,
                              [&](const auto& f) { return pairs_of(f, 0, 2, engine); });
}

// The oracle uses the whole filtration; every engine uses the forest.
template <class Data>
void expect_components_of_the_whole(const Data& data, const RipsOptions& options) {
  const Rips rips(data, options);
  const std::vector<Pair> expected = components_of(rips, RipsForm::edges, Engine::standard);
  const RipsGraph& forest = rips.graph(RipsForm::forest);
  EXPECT_TRUE(forest.is_forest());
  EXPECT_EQ(forest.size(), rips.graph(RipsForm::edges).size());
  EXPECT_LE(forest.edge_count(), static_cast<std::size_t>(std::max<Index>(forest.size() - 1, 0)));
  for (const auto& engine : detail::engine_facts()) {
    if (engine.id == Engine::standard || engine.id == Engine::gradient ||  // for images only
        engine.id == Engine::beta_skeleton)                                // for points only
      continue;
    EXPECT_EQ(components_of(rips, RipsForm::forest, engine.id), expected) << engine.id.name();
  }
  const Options task{.max_dim = 0, .min_persistence = -1};
  EXPECT_EQ(plan(rips, task).form, RipsForm::forest);
  EXPECT_EQ(pairs_of(persistence(rips, task)), expected);
}

/// Core distances, numbers that have nothing to do with the points, or a few values that many
/// points share. In each case, some points may enter at 0.
std::vector<double> births_of(Generator& random, const Points& points, PointDistance distance,
                              double minkowski_p, double unit) {
  const Index n = points.rows();
  const int kind = random.integer(0, 2);
  if (kind == 0 && n > 1)
    return core_distances(points, random.integer(1, int(std::min<Index>(n - 1, 9))), distance,
                          minkowski_p);
  std::vector<double> births(static_cast<std::size_t>(n));
  for (double& b : births)
    if (random.integer(0, 3) > 0) b = kind == 1 ? unit * random.real() : unit * random.value(true);
  return births;
}

constexpr PointDistance kSearched[] = {PointDistance::euclidean, PointDistance::manhattan,
                                       PointDistance::chebyshev, PointDistance::minkowski};

// Tests points with zero to five coordinates, copies, ties, and thresholds equal to distances. The
// squares of some numbers are beyond the range of doubles.
TEST(Components, OfPointsAreThoseOfTheWholeFiltration) {
  for_each_seed(12000, [](Generator& random, bool ties, std::int64_t) {
    Points points = random.points(random.integer(0, 22), random.integer(0, 5), ties);
    for (Index i = 1; i < points.rows(); ++i)
      if (random.integer(0, 4) == 0) copy_point(points, random.integer(0, int(i) - 1), points, i);
    double unit = 1;
    if (random.integer(0, 3) == 0) unit = std::ldexp(1, random.coin() ? 1000 : -1070);
    points = scaled(points, unit);
    RipsOptions options{.distance = kSearched[random.integer(0, 3)]};
    options.minkowski_p = random.coin() ? 1 + random.real() : 1 + 9 * random.real();
    if (random.coin()) options.threshold = unit * random.value(ties);
    if (random.coin())
      options.births = births_of(random, points, options.distance, options.minkowski_p, unit);
    expect_components_of_the_whole(points, options);
  });
}

TEST(Components, OfManyAxesAndOtherDistances) {
  for_each_seed(1500, [](Generator& random, bool ties, std::int64_t) {
    const Points points = random.points(random.integer(1, 24), random.integer(6, 20), ties);
    const bool is_cosine = random.coin() && as_matrix(points).rowwise().norm().minCoeff() > 0;
    RipsOptions options{.distance =
                            is_cosine ? PointDistance::cosine : kSearched[random.integer(0, 3)]};
    if (random.integer(0, 3) == 0) options.distance = PointDistance::hamming;
    if (random.coin()) options.threshold = 4 * random.value(ties);
    if (random.coin())
      options.births = births_of(random, points, options.distance, options.minkowski_p, 1);
    expect_components_of_the_whole(points, options);
  });
}

TEST(Components, OfAnyMatrixAreThoseOfTheWholeFiltration) {
  for_each_seed(6000, [](Generator& random, bool ties, std::int64_t) {
    const Index n = random.integer(0, 14);
    std::vector<double> lower(static_cast<std::size_t>(n * (n - 1) / 2));
    const int infinite = random.integer(0, 4);
    for (double& d : lower) d = random.integer(0, 9) < 2 * infinite ? kInf : random.value(ties);
    RipsOptions options;
    if (random.coin()) options.threshold = random.integer(0, 5) == 0 ? kInf : random.value(ties);
    expect_components_of_the_whole(DistanceMatrix(n, lower), options);
  });
}

TEST(Components, OfSparseDistances) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t) {
    RipsOptions options;
    if (random.coin()) options.threshold = random.value(ties);
    expect_components_of_the_whole(random.sparse(random.integer(0, 14), ties, random.real()),
                                   options);
  });
}

bool same_edges(const FlagEdge& a, const FlagEdge& b) {
  return a.value == b.value && a.u == b.u && a.v == b.v;
}

// A distance defined by the user takes indices, so it works for any points.
struct AnyDistance {
  const PointMetric& metric;
  Index size() const { return metric.size(); }
  double operator()(Index i, Index j) const { return metric(i, j); }
};

/// Clusters of clusters, a grid with many ties, a line, or scattered points.
Points many_points(Generator& random, Index n) {
  const Index d = random.coin() ? random.integer(1, 5) : random.integer(9, 14);
  Points points = random.points(n, d, false);
  const int kind = random.integer(0, 3);
  if (kind == 0) points = to_points((as_matrix(points) * 6).array().round());
  if (kind == 1)
    for (Index i = 0; i < n; ++i)
      as_matrix(points).row(i) = as_matrix(points).row(i) * std::ldexp(1, -random.integer(0, 60)) +
                                 as_matrix(points).row(random.integer(0, 4));
  if (kind == 2)
    for (Index k = 1; k < d; ++k) as_matrix(points).col(k) = as_matrix(points).col(0);
  return points;
}

// There are enough points to run all parts of the search.
TEST(Components, OfManyPointsAreThoseOfAllPairs) {
  for_each_seed(64, [](Generator& random, bool, std::int64_t) {
    const Points points = many_points(random, random.integer(200, 2500));
    RipsOptions options{.distance = kSearched[random.integer(0, 3)], .minkowski_p = 3};
    if (random.coin()) options.threshold = random.real() / 2;
    if (random.coin())
      options.births = births_of(random, points, options.distance, options.minkowski_p, 1);
    const PointMetric metric(points, options.distance, options.minkowski_p);
    const Rips of_all_pairs(AnyDistance{metric}, options);
    const auto expected = components_of(of_all_pairs, RipsForm::forest, Engine::union_find);
    for (const int threads : {1, 2, 5}) {
      RunContext context;
      context.threads = threads;
      const Rips rips(points, options, context);
      EXPECT_EQ(components_of(rips, RipsForm::forest, Engine::union_find, context), expected);
      EXPECT_TRUE(std::ranges::equal(rips.graph(RipsForm::forest).edges(),
                                     of_all_pairs.graph(RipsForm::forest).edges(), same_edges));
    }
  });
}

void expect_same_forest(const Rips& a, const Rips& b) {
  const RipsGraph &of_a = a.graph(RipsForm::forest), &of_b = b.graph(RipsForm::forest);
  EXPECT_TRUE(std::ranges::equal(of_a.edges(), of_b.edges(), same_edges));
  ASSERT_EQ(of_a.size(), of_b.size());
  for (Index v = 0; v < of_a.size(); ++v)
    EXPECT_EQ(of_a.birth(std::uint32_t(v)), of_b.birth(std::uint32_t(v)));
}

// The core distances and the edges are found together. With births that are given, each edge is
// compared.
TEST(Components, WithCoreDistancesAreThoseOfTheirBirths) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t seed) {
    const bool are_many = seed % 60 == 0;
    Points points = are_many ? many_points(random, random.integer(200, 1500))
                             : random.points(random.integer(2, 40), random.integer(1, 12), ties);
    if (random.integer(0, 3) == 0)
      for (Index i = 1; i < points.rows(); ++i)
        if (random.coin()) copy_point(points, random.integer(0, int(i) - 1), points, i);
    RipsOptions options{.distance = kSearched[random.integer(0, 3)], .minkowski_p = 3};
    const Index k = random.integer(1, int(std::min<Index>(points.rows() - 1, 20)));
    const PointMetric metric(points, options.distance, options.minkowski_p);
    RipsOptions with_births = options;
    with_births.births = core_distances(metric, k);
    options.core_neighbours = k;
    RunContext context;
    context.threads = random.integer(1, 3);
    expect_same_forest(Rips(points, options, context), Rips(AnyDistance{metric}, with_births));
  });
}

// If the input is a forest, no other form can be made from it.
TEST(Components, NothingElseIsThere) {
  const Points points = to_points(PointMatrix::Random(9, 2));
  const Rips rips(RipsGraph::forest_of_metric(PointMetric(points), {}, default_context()));
  EXPECT_EQ(persistence(rips).size(), 9U);
  expect_error(ErrorKind::usage, "has only components", [&] { persistence(rips, {.max_dim = 1}); });
  expect_error(ErrorKind::usage, "has only components", [&] { estimate(rips, {.max_dim = 2}); });
  EXPECT_EQ(estimate(rips).cells, (std::vector<double>{9, 8}));
  EXPECT_EQ(rips.graph(RipsForm::forest).threshold(), kInf);
  for (const RipsForm form : {RipsForm::edges, RipsForm::distinct_edges, RipsForm::points})
    expect_error(ErrorKind::usage, "of a graph", [&] { rips.graph(form); });
}

}  // namespace
}  // namespace ph::test
