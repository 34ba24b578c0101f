// SPDX-License-Identifier: MIT
// Tests which form of a Rips filtration is planned, and that all forms give the same bars.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "ph/distance_to_measure.hpp"
#include "ph/estimate.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/merge_tree.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

constexpr std::array kForms{RipsForm::edges, RipsForm::distinct_edges, RipsForm::forest,
                            RipsForm::points};
constexpr std::array kDistances{PointDistance::euclidean, PointDistance::manhattan,
                                PointDistance::chebyshev, PointDistance::hamming};
constexpr std::array kExponents{WeightExponent::infinity, WeightExponent::one, WeightExponent::two};

/// Random points, with ties if requested. About one point in six is a copy of an earlier point.
Points random_points(Generator& random, Index most, bool ties) {
  Points points =
      random.points(random.integer(0, static_cast<int>(most)), random.integer(1, 4), ties);
  for (Index i = 1; i < points.rows(); ++i)
    if (random.integer(0, 5) == 0)
      copy_point(points, random.integer(0, static_cast<int>(i) - 1), points, i);
  return points;
}

std::vector<double> random_births(Generator& random, Index n, bool ties) {
  std::vector<double> births(static_cast<std::size_t>(n));
  for (double& b : births) b = random.value(ties) / 2;
  return births;
}

DistanceMatrix matrix_of(PointsView points, PointDistance distance = PointDistance::euclidean) {
  const PointMetric metric(points, distance);
  std::vector<double> lower;
  for (Index i = 0; i < metric.size(); ++i)
    for (Index j = 0; j < i; ++j) lower.push_back(metric(i, j));
  return DistanceMatrix(metric.size(), lower);
}

// ---- what is planned

TEST(RipsPlans, TakeTheFormThatIsEnough) {
  const Points few(9, 2);
  Points many = Generator(1).points(6'000, 2, false);
  const auto form = [](const Rips& rips, const Options& options) {
    return plan(rips, options).form;
  };
  const Rips small(few), large = Rips::borrowed(many);
  EXPECT_EQ(form(small, {.max_dim = 0}), RipsForm::forest);
  EXPECT_EQ(form(small, {.max_dim = 0, .min_persistence = -1}), RipsForm::forest);
  EXPECT_EQ(form(small, {}), RipsForm::distinct_edges);
  EXPECT_EQ(form(large, {}), RipsForm::points);
  EXPECT_EQ(form(large, {.max_dim = 2}), RipsForm::distinct_edges);
  EXPECT_EQ(form(large, {.representatives = Representatives::cycles}), RipsForm::distinct_edges);
  for (const Rips& rips : {small, large}) {
    EXPECT_EQ(form(rips, {.min_persistence = -1}), RipsForm::edges);
    EXPECT_EQ(form(rips, {.representatives = Representatives::cocycles}), RipsForm::edges);
    EXPECT_EQ(form(rips.with({.merge_equal_points = false}), {.max_dim = 2}), RipsForm::edges);
    EXPECT_EQ(form(rips.with({.dtm_neighbours = 3}), {}), RipsForm::edges);
    EXPECT_EQ(form(rips.with({.dtm_neighbours = 3}), {.max_dim = 0}), RipsForm::forest);
  }
  EXPECT_EQ(form(small.with({.merge_equal_points = true}), {.min_persistence = -1}),
            RipsForm::distinct_edges);
  EXPECT_EQ(form(small.with({.births = std::vector<double>(9, 1)}), {}), RipsForm::edges);
  EXPECT_EQ(form(small, {.max_dim = 0, .engine = Engine::standard}), RipsForm::distinct_edges);
  EXPECT_EQ(form(small, {.engine = Engine::beta_skeleton}), RipsForm::points);
  EXPECT_EQ(form(small.with({.approximation = 1}), {.max_dim = 0}), RipsForm::distinct_edges);
  const Rips distances(matrix_of(few));
  EXPECT_EQ(form(distances, {.max_dim = 0}), RipsForm::forest);
  EXPECT_EQ(form(distances, {}), RipsForm::edges);
  EXPECT_EQ(plan(Cubical(Image{{2}, {0, 1}})).form, std::nullopt);
}

// An edge takes 16 bytes, and there would be 2 * 10^8 edges.
TEST(RipsPlans, MakeNoEdges) {
  const Points points = Generator(1).points(20'000, 3, false);
  const auto expect_little = [&](const RipsOptions& options, const Options& task) {
    RunContext home, call;
    const Rips rips = Rips::borrowed(points, options, home);
    plan(rips, task, call);
    EXPECT_LT(home.memory.peak() + call.memory.peak(), 1U << 20);
  };
  for (const RipsOptions& options :
       {RipsOptions{}, RipsOptions{.threshold = 0.3},
        RipsOptions{.distance = PointDistance::manhattan}, RipsOptions{.dtm_neighbours = 5},
        RipsOptions{.subsample = GreedyLimits{.points = 9'000}}}) {
    expect_little(options, {.max_dim = 0});
    expect_little(options, {.max_dim = 0, .min_persistence = -1});
    expect_little(options, {});
    expect_little(options, {.max_dim = 2});
    expect_little(options, {.max_dim = 3});
    expect_little(options, {.representatives = Representatives::cycles});
    expect_little(options, {.engine = Engine::edge_links});
  }
  // Edges are not needed for components and loops of points in the plane.
  const Points plane = Generator(1).points(20'000, 2, false);
  for (const int max_dim : {0, 1}) {
    RunContext home;
    persistence(Rips::borrowed(plane, {}, home), {.max_dim = max_dim, .cells = false}, home);
    EXPECT_LT(home.memory.peak(), std::size_t{64} << 20) << max_dim;
  }
  RunContext home;
  merge_tree(Rips::borrowed(points, {}, home), home);
  EXPECT_LT(home.memory.peak(), std::size_t{16} << 20);
}

/// All decisions of a plan, as text.
std::string said(const RunPlan& plan) {
  const Options& options = plan.options;
  return fmt::format("{} up to {}, form {}, collapse {}: {}; {}", options.engine.name(),
                     options.max_dim.value_or(-1), plan.form ? static_cast<int>(*plan.form) : -1,
                     static_cast<int>(options.collapse), plan.reason, plan.collapse_reason);
}

/// The plan as text, or the reason why no plan is possible.
std::string said(const Rips& rips, const Options& task,
                 const RunContext& context = default_context()) {
  try {
    return said(plan(rips, task, context));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    return error.what();
  }
}

TEST(RipsPlans, DependOnNothingButQuestionAndTask) {
  int planned = 0;
  for_each_seed(600, [&](Generator& random, bool ties, std::int64_t field) {
    RipsOptions options;
    if (random.coin()) options.threshold = random.value(ties);
    if (random.integer(0, 3) == 0) options.merge_equal_points = random.coin();
    const Points points = random_points(random, 12, ties);
    const auto make = [&] { return Rips(points, options); };
    const Rips used = make();
    for (const RipsForm form : kForms)
      if (random.coin()) used.graph(form);
    constexpr std::array engines{Engine::automatic, Engine::automatic, Engine::cohomology,
                                 Engine::standard};
    for (int i = 0; i < 4; ++i) {
      const Options task{.max_dim = random.integer(0, 5),
                         .field = field,
                         .engine = engines[static_cast<std::size_t>(random.integer(0, 3))],
                         .collapse = static_cast<Collapse>(2 * random.integer(0, 1)),
                         .min_persistence = random.integer(0, 3) == 0 ? -1.0 : 0.0,
                         .representatives = static_cast<Representatives>(random.integer(0, 2))};
      ThreadsContext context(random.integer(1, 4));
      context.memory.set_limit(std::size_t{1} << random.integer(24, 40));
      const std::string expected = said(make(), task);
      EXPECT_EQ(said(used, task), expected);
      EXPECT_EQ(said(used, task, context), expected);
      try {
        const Barcode bars = persistence(used, task);
        EXPECT_EQ(pairs_of(run(used, plan(used, task))), pairs_of(bars));
        EXPECT_EQ(said(used, task), expected);
        ++planned;
      } catch (const Error& error) {
        EXPECT_EQ(error.what(), expected);
      }
    }
  });
  EXPECT_TRUE(is_enough(planned, 1000)) << planned;
}

// A plan that is made from the options of another plan equals that plan. Plans that lower max_dim
// to 0, because there are no edges, are left out.
TEST(RipsPlans, AreSettled) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random_points(random, 12, ties));
    const int max_dim = random.integer(0, 5);
    const RunPlan first = plan(rips, {.max_dim = max_dim, .field = field});
    if (max_dim > 0 && first.options.max_dim == 0) return;
    const RunPlan second = plan(rips, first.options);
    EXPECT_EQ(second.options.engine, first.options.engine);
    EXPECT_EQ(second.options.max_dim, first.options.max_dim);
    EXPECT_EQ(second.options.collapse, first.options.collapse);
    EXPECT_EQ(second.form, first.form);
  });
}

TEST(RipsPlans, AreOfOneKindOfComplex) {
  const Rips rips(Points{{0}, {1}});
  const Cubical cubical(Image{{2}, {0, 1}});
  expect_error(ErrorKind::usage, "a complex other than a Rips filtration",
               [&] { run(rips, plan(cubical)); });
  EXPECT_FALSE(facts(cubical, plan(cubical)).vertices);
}

TEST(RipsFacts, AreThoseOfTheForm) {
  const Points points{{0}, {2}, {0}, {1}};
  const Rips rips(points);
  const auto of = [&](const Rips& asked, const Options& task) {
    return facts(asked, plan(asked, task));
  };
  const RunFacts loops = of(rips, {});
  EXPECT_EQ(loops.vertices, 3);
  EXPECT_EQ(loops.edges, 2U);
  EXPECT_EQ(loops.threshold, 1);
  EXPECT_EQ(loops.covering_radius, std::nullopt);
  const RunFacts components = of(rips, {.max_dim = 0});
  EXPECT_EQ(components.vertices, 4);
  EXPECT_EQ(components.edges, 3U);
  EXPECT_EQ(components.threshold, std::nullopt);
  const RunFacts alone = of(rips, {.engine = Engine::beta_skeleton});
  EXPECT_EQ(alone.vertices, 3);
  EXPECT_EQ(alone.edges, std::nullopt);
  const RunFacts sample = of(rips.with({.subsample = GreedyLimits{.points = 2}}), {});
  EXPECT_EQ(sample.vertices, 2);
  EXPECT_EQ(sample.covering_radius, 1);
}

// ---- agreement of all forms

std::vector<Pair> pairs_of_form(const Rips& rips, RipsForm form, int max_dim, std::int64_t field,
                                Engine engine) {
  return with_rips_filtration(rips.graph(form), max_dim,
                              [&](const auto& f) { return pairs_of(f, max_dim, field, engine); });
}

TEST(RipsForms, HaveTheSameBarsAndCells) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random_points(random, random.integer(0, 9) == 0 ? 40 : 12, ties);
    RipsOptions options{.distance = kDistances[static_cast<std::size_t>(random.integer(0, 3))]};
    if (random.coin()) options.threshold = 2 * random.value(ties);
    if (random.integer(0, 2) == 0) options.births = random_births(random, points.rows(), ties);
    if (random.coin())
      options.weight_exponent = kExponents[static_cast<std::size_t>(random.integer(0, 2))];
    if (random.integer(0, 3) == 0)
      for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(points.rows()); ++v)
        if (random.integer(0, 3) > 0) options.vertices.push_back(v);
    const Rips rips(points, options);
    const int max_dim = points.rows() > 12 ? 1 : random.integer(1, 2);
    const auto all = pairs_of_form(rips, RipsForm::edges, max_dim, field, Engine::standard);
    const auto components = pairs_of_form(rips, RipsForm::edges, 0, field, Engine::standard);
    EXPECT_EQ(pairs_of_form(rips, RipsForm::forest, 0, field, Engine::union_find), components);
    const auto distinct =
        pairs_of_form(rips, RipsForm::distinct_edges, max_dim, field, Engine::standard);
    EXPECT_EQ(of_positive_length(distinct), of_positive_length(all));
    if (!options.births.empty()) {
      EXPECT_EQ(distinct, all) << "copies with births are not merged";
    }
    // Whatever the plan decides, it must give these bars.
    const auto planned = [&](int dim, double least, std::optional<bool> merges) {
      RipsOptions asked = options;
      asked.merge_equal_points = merges;
      return pairs_of(persistence(
          rips.with(asked),
          {.max_dim = dim, .field = field, .collapse = Collapse::off, .min_persistence = least}));
    };
    EXPECT_EQ(planned(0, -1, {}), components);
    EXPECT_EQ(planned(0, -1, false), components);
    EXPECT_EQ(planned(max_dim, -1, {}), all);
    EXPECT_EQ(planned(max_dim, -1, false), all);
    for (const std::optional<bool> merges : {std::optional<bool>(), std::optional(true)}) {
      EXPECT_EQ(planned(0, 0, merges), of_positive_length(components));
      EXPECT_EQ(planned(max_dim, 0, merges), of_positive_length(all));
    }
    if (options.births.empty() && options.distance == PointDistance::euclidean) {
      const auto loops = pairs_of_form(rips, RipsForm::edges, 1, field, Engine::standard);
      EXPECT_EQ(pairs_of(persistence(rips, {.field = field, .engine = Engine::beta_skeleton})),
                of_positive_length(loops));
    }
  });
}

TEST(RipsForms, OfDistancesHaveTheSameComponents) {
  for_each_seed(2000, [](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(0, 14);
    RipsOptions options;
    if (random.coin()) options.threshold = random.value(ties);
    if (random.integer(0, 2) == 0) options.births = random_births(random, n, ties);
    if (random.coin())
      options.weight_exponent = kExponents[static_cast<std::size_t>(random.integer(0, 2))];
    const Rips rips = random.coin() ? Rips(random.distances(n, ties), options)
                                    : Rips(random.sparse(n, ties, random.real()), options);
    const auto expected = pairs_of_form(rips, RipsForm::edges, 0, field, Engine::standard);
    EXPECT_EQ(pairs_of_form(rips, RipsForm::forest, 0, field, Engine::union_find), expected);
    EXPECT_EQ(pairs_of(persistence(rips, {.max_dim = 0, .field = field, .min_persistence = -1})),
              expected);
  });
}

// ---- births and vertices that the options choose

TEST(RipsChoices, AreThoseMadeByHand) {
  for_each_seed(2000, [](Generator& random, bool ties, std::int64_t field) {
    Points points = random_points(random, 14, ties);
    if (points.rows() == 0) points = Points(1, 2);
    const int n = static_cast<int>(points.rows());
    const PointDistance distance = kDistances[static_cast<std::size_t>(random.integer(0, 3))];
    RipsOptions chosen{.distance = distance};
    if (random.coin()) chosen.threshold = 1 + random.value(ties);
    RipsOptions by_hand = chosen;
    std::optional<double> radius;
    if (random.coin()) {
      chosen.dtm_neighbours = random.integer(1, n);
      by_hand.births = distance_to_measure(points, *chosen.dtm_neighbours, distance);
      for (double& birth : by_hand.births) birth *= 2;
      by_hand.weight_exponent = WeightExponent::one;
      if (random.coin())
        by_hand.weight_exponent = chosen.weight_exponent =
            kExponents[static_cast<std::size_t>(random.integer(0, 2))];
    }
    if (random.coin() || !chosen.dtm_neighbours) {
      chosen.subsample = GreedyLimits{.points = random.integer(1, n),
                                      .radius = random.coin() ? 0 : random.value(ties)};
      const GreedyPermutation sample = greedy_permutation(points, *chosen.subsample, distance);
      by_hand.vertices = sample.ascending();
      radius = sample.covering_radius;
    }
    const DistanceMatrix matrix = matrix_of(points, distance);
    const PointMetric metric(points, distance);
    const int max_dim = random.integer(0, 2);
    const double least = random.coin() ? 0 : -1;
    const auto expect_same = [&](const auto& data) {
      const Rips asked(data, chosen), expected(data, by_hand);
      EXPECT_EQ(asked.covering_radius(), radius);
      const Options task{
          .max_dim = max_dim, .field = field, .collapse = Collapse::off, .min_persistence = least};
      EXPECT_EQ(plan(asked, task).form, plan(expected, task).form);
      EXPECT_EQ(pairs_of(persistence(asked, task)), pairs_of(persistence(expected, task)));
      EXPECT_EQ(facts(asked, plan(asked, task)).covering_radius, radius);
      const auto births = [](const Rips& rips) {
        const std::span<const double> found = all_edges(rips).births();
        return std::vector(found.begin(), found.end());
      };
      EXPECT_EQ(births(asked), births(expected));
    };
    expect_same(points);
    expect_same(matrix);
    expect_same(metric);
  });
}

TEST(RipsChoices, OfTheExponentOfMinkowski) {
  const Points points = Generator(5).points(20, 3, false);
  const RipsOptions options{.distance = PointDistance::minkowski,
                            .minkowski_p = 3,
                            .dtm_neighbours = 4,
                            .subsample = GreedyLimits{.points = 12}};
  RipsOptions by_hand{.distance = PointDistance::minkowski, .minkowski_p = 3};
  by_hand.births = distance_to_measure(points, 4, PointDistance::minkowski, 3);
  for (double& birth : by_hand.births) birth *= 2;
  by_hand.weight_exponent = WeightExponent::one;
  by_hand.vertices =
      greedy_permutation(points, {.points = 12}, PointDistance::minkowski, 3).ascending();
  EXPECT_EQ(pairs_of(persistence(Rips(points, options))),
            pairs_of(persistence(Rips(points, by_hand))));
}

TEST(RipsChoices, TakeThePlaceOfThoseGiven) {
  const Points points = Generator(5).points(20, 2, false);
  const std::vector<double> births(20, 0.1);
  EXPECT_EQ(pairs_of(persistence(Rips(points, {.births = births, .dtm_neighbours = 4}))),
            pairs_of(persistence(Rips(points, {.dtm_neighbours = 4}))));
  const GreedyLimits half{.points = 10};
  EXPECT_EQ(pairs_of(persistence(Rips(points, {.vertices = {3, 4}, .subsample = half}))),
            pairs_of(persistence(Rips(points, {.subsample = half}))));
  std::vector<double> lower;
  for (Index i = 0; i < 20; ++i)
    for (Index j = 0; j < i; ++j) lower.push_back(PointMetric(points)(i, j));
  EXPECT_EQ(pairs_of(persistence(Rips(DistanceMatrix(20, lower, births), {.dtm_neighbours = 4}))),
            pairs_of(persistence(Rips(points, {.dtm_neighbours = 4}))));
}

TEST(RipsChoices, ThatMakeNoSenseAreRefused) {
  const Points points(5, 2);
  for (const Index bad : {-1, 0, 6})
    expect_error(ErrorKind::usage, "neighbours", [&] { Rips(points, {.dtm_neighbours = bad}); });
  expect_error(ErrorKind::usage, "at least 1",
               [&] { Rips(points, {.subsample = GreedyLimits{.points = 0}}); });
  expect_error(ErrorKind::usage, "births",
               [&] { Rips(points, {.dtm_neighbours = 2, .approximation = 1}); });
  const SparseDistances some(2, {{0, 1, 1}});
  expect_error(ErrorKind::usage, "expected all", [&] { Rips(some, {.dtm_neighbours = 1}); });
  expect_error(ErrorKind::usage, "expected all",
               [&] { Rips(some, {.subsample = GreedyLimits{}}); });
  expect_error(ErrorKind::usage, "all distances", [&] { Rips(some, {.approximation = 1}); });
}

// ---- estimates of forms that do not fit into memory

/// The approximate number of pairs within a distance.
double pairs_within(const Points& points, double limit) {
  Generator random(9);
  const PointMetric metric(points);
  const int last = static_cast<int>(points.rows()) - 1;
  constexpr int sampled = 400'000;
  int within = 0, pairs = 0;
  for (int i = 0; i < sampled; ++i) {
    const Index a = random.integer(0, last), b = random.integer(0, last);
    if (a == b) continue;
    ++pairs;
    within += metric(a, b) <= limit ? 1 : 0;
  }
  const auto n = static_cast<double>(points.rows());
  return n * (n - 1) / 2 * within / pairs;
}

/// The enclosing radius of points that fill a square.
double enclosing_radius(const Points& points) {
  const PointMetric metric(points);
  double least = kInfinity;
  for (Index i = 0; i < points.rows(); ++i) {
    if (std::hypot(points(i, 0) - 0.5, points(i, 1) - 0.5) > 0.02) continue;
    double largest = 0;
    for (Index j = 0; j < points.rows(); ++j) largest = std::max<double>(largest, metric(i, j));
    least = std::min(least, largest);
  }
  return least;
}

TEST(RipsEstimates, NeverExceedTheMemoryLimit) {
  const Points points = Generator(1).points(20'000, 2, false);
  const double of_all = pairs_within(points, enclosing_radius(points));
  for (const std::size_t limit : {std::size_t{1} << 30, std::size_t{64} << 20}) {
    LimitedContext context(limit);
    const Rips rips(points, {}, context);
    const Estimate e = estimate(rips, {.max_dim = 2}, context);
    EXPECT_LE(context.memory.peak(), limit);
    EXPECT_EQ(e.options.engine, Engine::edge_links);
    ASSERT_GE(e.cells.size(), 2U);
    EXPECT_EQ(e.cells[0], 20'000);
    EXPECT_EQ(e.counted_dims, 1) << "edges are estimated";
    EXPECT_FALSE(e.built.edges);
    // For the enclosing radius, the estimate considers only sampled points as centres. Its radius
    // is therefore at least the enclosing radius.
    EXPECT_GT(e.cells[1], 0.95 * of_all);
    EXPECT_LT(e.cells[1], 1.25 * of_all);
    EXPECT_GT(e.bytes_low, 0.85 * 16 * of_all);
    EXPECT_GE(e.bytes_high, e.bytes_low);
    EXPECT_EQ(said(e), said(plan(Rips::borrowed(points), {.max_dim = 2})));
  }
  for (const double threshold : {0.3, 0.05}) {
    LimitedContext context(std::size_t{64} << 20);
    const Rips rips(points, {.threshold = threshold}, context);
    const double expected = pairs_within(points, threshold);
    const Estimate e = estimate(rips, {.max_dim = 2}, context);
    EXPECT_LE(context.memory.peak(), context.memory.limit());
    EXPECT_NEAR(e.cells.at(1), expected, 0.08 * expected) << threshold;
  }
}

TEST(RipsEstimates, OfWhatNeedsNoEdgesAreMade) {
  const Points points = Generator(1).points(20'000, 2, false);
  for (const int max_dim : {0, 1}) {
    LimitedContext context(std::size_t{64} << 20);
    const Rips rips(points, {}, context);
    const Estimate e = estimate(rips, {.max_dim = max_dim}, context);
    EXPECT_EQ(e.form, max_dim == 0 ? RipsForm::forest : RipsForm::points);
    EXPECT_LE(e.bytes_high, std::size_t{64} << 20);
    EXPECT_NO_THROW(persistence(rips, {.max_dim = max_dim}, context));
    EXPECT_LE(context.memory.peak(), context.memory.limit());
  }
}

// The estimate is the same whether it is the first or a later one, and agrees with the plan.
TEST(RipsEstimates, WhereTheyFitAreThoseOfTheForm) {
  for_each_seed(100, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random_points(random, 20, ties));
    const Options task{.max_dim = random.integer(0, 4), .field = field};
    const Estimate first = estimate(rips, task), second = estimate(rips, task);
    EXPECT_EQ(said(first), said(second));
    EXPECT_EQ(first.cells, second.cells);
    EXPECT_EQ(first.bytes_high, second.bytes_high);
    EXPECT_EQ(first.form, plan(rips, task).form);
    EXPECT_EQ(first.options.engine, plan(rips, task).options.engine);
  });
}

TEST(RipsEstimates, OfGraphsThatWereGiven) {
  const std::vector<WeightedEdge> square{{0, 1, 1}, {1, 2, 1}, {2, 3, 1}, {3, 0, 1}};
  const Rips rips(RipsGraph::of_edges(4, square, {}, default_context()));
  for (const int max_dim : {0, 1, 4}) {
    const Estimate e = estimate(rips, {.max_dim = max_dim});
    EXPECT_EQ(e.cells.at(1), 4);
    EXPECT_EQ(e.built.edges, 4U);
  }
  Rips used(Generator(1).points(30, 2, false));
  const Estimate expected = estimate(used);
  used.forget_input();
  EXPECT_EQ(estimate(used).cells, expected.cells);
}

// If there are many points but few edges, the edges are built and counted exactly.
TEST(RipsEstimates, OfFewEdgesAreExact) {
  Points copies(4'000, 2);
  for (Index i = 0; i < copies.rows(); ++i) {
    copies(i, 0) = static_cast<double>(i % 20);
    copies(i, 1) = static_cast<double>(i / 20 % 10);
  }
  const auto expect_exact = [](const Points& points, const RipsOptions& options) {
    LimitedContext context(std::size_t{16} << 20);
    const Rips rips(points, options, context);
    const Options task{.max_dim = 2};
    const Estimate e = estimate(rips, task, context);
    const auto edges = *facts(rips, plan(rips, task), context).edges;
    EXPECT_EQ(e.cells.at(1), static_cast<double>(edges));
    EXPECT_EQ(e.built.edges, edges);
    EXPECT_LE(e.bytes_low, std::size_t{16} << 20);
  };
  expect_exact(copies, {});
  expect_exact(Generator(1).points(4'000, 2, false), {.approximation = 1});
}

TEST(RipsEstimates, OfOwnMetricsAndDistancesDoNotExceedTheLimit) {
  const Points points = Generator(1).points(3'000, 3, false);
  const DistanceMatrix matrix = matrix_of(points);
  const double expected = pairs_within(points, 0.5);
  const auto expect_about = [&](const auto& data) {
    LimitedContext context(std::size_t{4} << 20);
    const Rips rips(data, {.threshold = 0.5}, context);
    for (const Options& task :
         {Options{.max_dim = 2}, Options{.max_dim = 4}, Options{.engine = Engine::cohomology}}) {
      const Estimate e = estimate(rips, task, context);
      EXPECT_LE(context.memory.peak(), context.memory.limit());
      EXPECT_NEAR(e.cells.at(1), expected, 0.08 * expected);
    }
  };
  expect_about(matrix);
  expect_about(PointMetric(points));
}

}  // namespace
}  // namespace ph::test
