// SPDX-License-Identifier: MIT
// Weighted Rips filtrations, whose vertices enter late: compares them with the definition.
#include <limits>
#include <numeric>

#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/rips_graphs.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr WeightExponent kExponents[] = {WeightExponent::infinity, WeightExponent::one,
                                         WeightExponent::two};

std::vector<double> random_births(Generator& random, Index n, bool ties) {
  std::vector<double> births(static_cast<std::size_t>(n));
  for (double& b : births) b = random.value(ties);
  return births;
}

/// A random subset of the numbers 0 to n-1 in ascending order. It may be empty.
std::vector<std::uint32_t> random_vertices(Generator& random, Index n) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t v = 0; v < n; ++v)
    if (random.integer(0, 3) > 0) chosen.push_back(v);
  return chosen;
}

/// The radius (t^p - b^p)^(1/p) / 2, at diameter t, of a ball that is born at b.
double radius(double t, double b, WeightExponent exponent) {
  switch (exponent) {
    case WeightExponent::one:
      return (t - b) / 2;
    case WeightExponent::two:
      return std::sqrt(t * t - b * b) / 2;
    case WeightExponent::infinity:
      break;
  }
  return t / 2;
}

TEST(VertexWeights, EdgesEnterWhenBallsMeet) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t) {
    const double b[] = {random.value(ties), random.value(ties)}, d = 2 * random.value(ties);
    for (const WeightExponent exponent : kExponents) {
      const double t = VertexWeights(b, exponent).edge_value(0, 1, d);
      EXPECT_EQ(VertexWeights(b, exponent).edge_value(1, 0, d), t);
      ASSERT_GE(t, std::max({b[0], b[1], d}));
      const double reach = radius(t, b[0], exponent) + radius(t, b[1], exponent);
      // If a difference is nearly 0, its root is inexact.
      EXPECT_GE(reach, d * (1 - 1e-7) - 1e-7);
      if (t > std::max(b[0], b[1])) {
        EXPECT_NEAR(reach, d, 1e-7) << "they met before";
      }
    }
  });
  const std::vector<double> none;
  EXPECT_EQ(VertexWeights().edge_value(0, 1, 3), 3);
  const double huge[] = {1e308, 1.7e308};
  EXPECT_EQ(VertexWeights(huge, WeightExponent::two).edge_value(0, 1, 1e-300), 1.7e308);
  EXPECT_EQ(VertexWeights(huge, WeightExponent::one).edge_value(0, 1, kInf), kInf);
  expect_error(ErrorKind::bad_data, "largest double",
               [&] { VertexWeights(huge, WeightExponent::one).edge_value(0, 1, 1e308); });
}

/// The same filtration as a list of simplices, numbered as in the input.
ExplicitComplex listed(const DistanceMatrix& distances, const RipsOptions& options, int top) {
  const VertexWeights weights(options.births, *options.weight_exponent);
  const double limit = options.threshold.value_or(kInf);
  std::vector<Index> chosen(options.vertices.begin(), options.vertices.end());
  if (chosen.empty()) {
    chosen.resize(static_cast<std::size_t>(distances.size()));
    std::iota(chosen.begin(), chosen.end(), Index{0});
  }
  SimplexList list;
  std::vector<Index> simplex;
  const auto extend = [&](auto&& self, std::size_t next, double value) -> void {
    if (!simplex.empty()) list.add(simplex, value);
    if (static_cast<int>(simplex.size()) > top) return;
    for (std::size_t i = next; i < chosen.size(); ++i) {
      const Index v = chosen[i];
      double with = std::max(
          value, options.births.empty() ? 0.0 : options.births[static_cast<std::size_t>(v)]);
      for (const Index u : simplex)
        with = std::max(with, weights.edge_value(u, v, distances(u, v)));
      if (with > limit || with == kInf) continue;
      simplex.push_back(v);
      self(self, i + 1, with);
      simplex.pop_back();
    }
  };
  extend(extend, 0, 0);
  return ExplicitComplex::from_simplices(list);
}

// For every way to store the distances, the bars are the bars of a filtration that lists each
// simplex with its value by the definition.
TEST(WeightedRips, IsTheFiltrationThatItSays) {
  for_each_seed(20000, [](Generator& random, bool ties, std::int64_t field) {
    const int max_dim = random.integer(0, 2);
    const Index n = random.integer(1, 8);
    const DistanceMatrix distances = random.distances(n, ties);
    const std::vector<double> births = random_births(random, n, ties);
    const std::vector<std::uint32_t> chosen =
        random.coin() ? random_vertices(random, n) : std::vector<std::uint32_t>();
    RipsOptions options;
    if (random.integer(0, 3) > 0) options.births = births;
    options.vertices = chosen;
    options.weight_exponent = kExponents[random.integer(0, 2)];
    if (random.coin()) options.threshold = random.value(ties);
    const auto bars = [&](const auto& complex) {
      return bars_of(persistence(complex, {.max_dim = max_dim, .field = field}));
    };
    const auto expected = bars(listed(distances, options, max_dim + 1));
    EXPECT_EQ(bars(Rips(distances, options)), expected);
    std::vector<WeightedEdge> edges;
    for (Index u = 0; u < n; ++u)
      for (Index v = 0; v < u; ++v) edges.push_back({u, v, distances(u, v)});
    EXPECT_EQ(bars(Rips(SparseDistances(n, edges), options)), expected);
    if (max_dim == 0) {
      const auto components = [&](const Rips& rips) {
        const RunPlan of_forest = plan(rips, {.max_dim = 0, .field = field});
        EXPECT_EQ(of_forest.form, RipsForm::forest);
        return bars_of(run(rips, of_forest));
      };
      EXPECT_EQ(components(Rips(distances, options)), expected);
      EXPECT_EQ(components(Rips(SparseDistances(n, edges), options)), expected);
    }
  });
}

// Compares every engine, and the edge collapse, with the oracle. There are ties among births, and
// between births and edges.
TEST(WeightedRips, PassesTheSuite) {
  for_each_seed(6000, [](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(0, 9);
    const std::vector<double> births = random_births(random, n, ties);
    RipsOptions options{.births = births, .weight_exponent = kExponents[random.integer(0, 2)]};
    if (random.coin()) options.threshold = random.value(ties);
    const int max_dim = random.integer(0, 3);
    switch (random.integer(0, 2)) {
      case 0:
        return check(Rips(random.points(n, random.integer(1, 4), ties), options), max_dim, {field});
      case 1:
        return check(Rips(random.distances(n, ties), options), max_dim, {field});
      default:
        return check(Rips(random.sparse(n, ties, random.real()), options), max_dim, {field});
    }
  });
}

TEST(WeightedRips, CollapseLeavesTheBarsAsTheyAre) {
  for_each_seed(20000, [](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(0, 9);
    const std::vector<double> births = random_births(random, n, ties);
    RipsOptions options{.births = births, .weight_exponent = kExponents[random.integer(0, 2)]};
    if (random.coin()) options.threshold = random.value(ties);
    const Rips rips = random.coin() ? Rips(random.distances(n, ties), options)
                                    : Rips(random.sparse(n, ties, random.real()), options);
    const RipsGraph fewer = collapse_edges(all_edges(rips));
    for (const FlagEdge& e : fewer.edges())
      EXPECT_GE(e.value, std::max(all_edges(rips).birth(e.u), all_edges(rips).birth(e.v)));
    check_collapse(rips, random.integer(0, 2), field);
  });
}

// Beyond the enclosing radius, nothing changes. Every vertex is born before this value.
TEST(WeightedRips, TheDefaultThresholdIsEnough) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(1, 8);
    const DistanceMatrix distances = random.distances(n, ties);
    const std::vector<double> births = random_births(random, n, ties);
    RipsOptions options{.births = births, .weight_exponent = kExponents[random.integer(0, 2)]};
    const Rips rips(distances, options);
    EXPECT_GE(all_edges(rips).threshold(), *std::ranges::max_element(births));
    options.threshold = kInf;
    const Options wanted{.max_dim = 2, .field = field};
    EXPECT_EQ(bars_of(persistence(rips, wanted)),
              bars_of(persistence(Rips(distances, options), wanted)));
  });
}

TEST(WeightedRips, PointsAndTheirMatrixAreOne) {
  for_each_seed(1500, [](Generator& random, bool ties, std::int64_t) {
    const Index n = random.integer(1, 20);
    const Points points = random.points(n, random.integer(1, 3), ties);
    const std::vector<double> births = random_births(random, n, ties);
    const std::vector<std::uint32_t> chosen = random_vertices(random, n);
    RipsOptions options{
        .vertices = chosen, .births = births, .weight_exponent = kExponents[random.integer(0, 2)]};
    if (random.coin()) options.threshold = random.value(ties);
    const RipsForm form = random.integer(0, 3) == 0 ? RipsForm::forest : RipsForm::edges;
    const PointMetric metric(points);
    const Rips rips_of_points(points, options), rips_of_metric(metric, options);
    const RipsGraph& of_points = rips_of_points.graph(form);
    const RipsGraph& of_metric = rips_of_metric.graph(form);
    const auto edges = [](const RipsGraph& graph) {
      std::vector<std::array<double, 3>> list;
      for (const FlagEdge& e : graph.edges()) list.push_back({e.value, double(e.u), double(e.v)});
      return list;
    };
    EXPECT_EQ(edges(of_points), edges(of_metric));
    ASSERT_EQ(of_points.size(), of_metric.size());
    for (std::uint32_t v = 0; v < of_points.size(); ++v) {
      EXPECT_EQ(of_points.name(v), of_metric.name(v));
      EXPECT_EQ(of_points.birth(v), births[static_cast<std::size_t>(of_points.name(v))]);
    }
  });
}

TEST(WeightedRips, AMatrixBringsItsBirths) {
  const DistanceMatrix distances(3, {1, 4, 2}, {0.5, 0, 3});
  const std::vector<Bar> expected{{0, 0, kInf}, {0, 0.5, 1}};
  EXPECT_EQ(bars_of(persistence(Rips(distances))), expected);
  const std::vector<double> others{0, 0, 0};
  EXPECT_EQ(persistence(Rips(distances, {.births = others})).bars(0).size(), 3U);
}

TEST(WeightedRips, TheElderIsWhoIsBornFirst) {
  const std::vector<double> births{2, 1, 2};
  const Rips rips(DistanceMatrix(3, {3, 4, 9}), {.births = births});
  for (const int max_dim : {0, 1}) {
    const Barcode bars = persistence(rips, {.max_dim = max_dim});
    ASSERT_EQ(bars.bars(0).size(), 3U);
    EXPECT_EQ(bars[0], (Bar{0, 1, kInf}));
    EXPECT_EQ(bars.birth_cell(1).numbers[0], 0);
    EXPECT_EQ(bars.birth_cell(2).numbers[0], 2);
  }
  const MergeTree tree = merge_tree(rips);
  EXPECT_EQ(tree.births, births);
  ASSERT_EQ(tree.merges.size(), 2U);
  EXPECT_EQ(tree.merges[0].elder, 1);
  EXPECT_EQ(tree.merges[0].elder_birth, 1);
}

TEST(WeightedRips, WhoIsBornBeyondTheThresholdNeverEnters) {
  const std::vector<double> births{0, 9, 0};
  const Barcode bars =
      persistence(Rips(DistanceMatrix(3, {1, 1, 1}), {.threshold = 5, .births = births}));
  ASSERT_EQ(bars.size(), 2U);
  EXPECT_EQ(bars.birth_cell(0).numbers[0], 2);
  EXPECT_EQ((*bars.death_cell(0)).numbers[0], 0);
  EXPECT_EQ((*bars.death_cell(0)).numbers[1], 2);
  expect_error(ErrorKind::usage, "all points", [&] {
    merge_tree(Rips(DistanceMatrix(3, {1, 1, 1}), {.threshold = 5, .births = births}));
  });
}

TEST(WeightedRips, RefusesWhatMakesNoSense) {
  const Points points(3, 2);
  for (const double bad : {-1.0, kNan, kInf}) {
    const std::vector<double> births{0, bad, 0};
    expect_error(ErrorKind::bad_data, "vertex 1: found birth",
                 [&] { Rips(points, {.births = births}); });
    expect_error(ErrorKind::bad_data, "vertex 1: found birth", [&] {
      Rips(DistanceMatrix(3, {1, 1, 1}, births));
    });
  }
  const std::vector<double> two{0, 1};
  expect_error(ErrorKind::usage, "one for each of 3", [&] { Rips(points, {.births = two}); });
  for (const std::vector<std::uint32_t>& bad : {std::vector<std::uint32_t>{0, 3}, {1, 0}, {1, 1}})
    expect_error(ErrorKind::usage, "ascending", [&] { Rips(points, {.vertices = bad}); });
}

}  // namespace
}  // namespace ph::test
