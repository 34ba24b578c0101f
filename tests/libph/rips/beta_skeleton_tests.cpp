// SPDX-License-Identifier: MIT
// The edges that are found from points alone give the same pairs as all edges, cell by cell, even
// with ties.
#include <cmath>
#include <numbers>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/estimate.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

/// Points in one of several shapes, with ties if requested.
Points shaped_points(Generator& random, Index n, Index d, bool ties) {
  Points p(n, d);
  const int shape = random.integer(0, 6), side = random.integer(1, 6);
  const double angle_step = 2 * std::numbers::pi / static_cast<double>(std::max<Index>(n, 1));
  for (Index i = 0; i < n; ++i) {
    const auto row = p.row(i);
    for (double& x : row) x = ties ? random.integer(0, side) : random.real();
    const double angle = ties ? static_cast<double>(i) * angle_step : 7 * random.real();
    switch (shape) {
      case 0:  // a grid with copies, or a cube
        break;
      case 1:  // a line
        for (std::size_t k = 1; k < row.size(); ++k) row[k] = row[0] * static_cast<double>(k);
        break;
      case 2:  // a circle, or an annulus
        if (d < 2) break;
        row[0] = std::cos(angle) * (ties ? 1 : 1 + 0.4 * random.real());
        row[1] = std::sin(angle) * (ties ? 1 : 1 + 0.4 * random.real());
        for (std::size_t k = 2; k < row.size(); ++k) row[k] *= 0.1;
        break;
      case 3:  // clusters of many sizes
        for (double& x : row) x = random.integer(0, 2) + x * std::pow(10, -random.integer(0, 9));
        break;
      case 4:  // copies of few points
        if (i > 3) std::ranges::copy(p.row(random.integer(0, 3)), row.begin());
        break;
      case 5:  // two circles side by side
        if (d < 2) break;
        row[0] = std::cos(angle) + (i % 2 == 0 ? 2.5 : 0);
        row[1] = std::sin(angle);
        break;
      default:  // far from the origin, where differences have few digits
        for (double& x : row) x = 1e6 + x * 1e-8;
    }
  }
  return p;
}

/// Compares the result computed from edges with the result computed from the points alone.
void expect_same(const Points& points, RipsOptions rips, const Options& task, int threads) {
  Options by_edges = task;
  by_edges.engine = points.rows() <= 16 ? Engine::standard : Engine::edge_links;
  rips.merge_equal_points = false;
  const Rips all(points, rips);
  ASSERT_EQ(plan(all, by_edges).form, RipsForm::edges);
  const auto expected = pairs_of(persistence(all, by_edges));
  ThreadsContext context(threads);
  rips.merge_equal_points = std::nullopt;
  const Rips alone(points, rips, context);
  Options by_points = task;
  by_points.engine = Engine::beta_skeleton;
  ASSERT_EQ(plan(alone, by_points).form, RipsForm::points);
  const Barcode found = persistence(alone, by_points, context);
  EXPECT_EQ(pairs_of(found), expected);
  by_points.cells = false;
  EXPECT_TRUE(std::ranges::equal(persistence(alone, by_points, context), found));
}

void check_random(Generator& random, bool ties, std::int64_t field, Index n) {
  const Points points = shaped_points(random, n, random.integer(1, 4), ties);
  RipsOptions rips;
  std::vector<std::uint32_t> vertices;
  if (random.integer(0, 2) == 0) rips.threshold = ties ? random.integer(0, 3) : random.real();
  if (random.integer(0, 4) == 0) {
    for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(n); ++v)
      if (random.coin()) vertices.push_back(v);
    rips.vertices = vertices;
  }
  expect_same(points, rips, {.max_dim = random.integer(0, 9) == 0 ? 0 : 1, .field = field},
              random.integer(1, 3));
}

TEST(BetaSkeleton, FewPoints) {
  for_each_seed(20'000, [](Generator& random, bool ties, std::int64_t field) {
    check_random(random, ties, field, random.integer(0, 16));
  });
}

TEST(BetaSkeleton, SomePoints) {
  for_each_seed(4'000, [](Generator& random, bool ties, std::int64_t field) {
    check_random(random, ties, field, random.integer(17, 90));
  });
}

TEST(BetaSkeleton, HundredsOfPoints) {
  for_each_seed(160, [](Generator& random, bool ties, std::int64_t field) {
    check_random(random, ties, field, random.integer(200, 500));
  });
}

// Compares with edge links. There are so many points that the tree has many levels.
TEST(BetaSkeleton, ThousandsOfPoints) {
  for_each_seed(10, [](Generator& random, bool ties, std::int64_t field) {
    const Index n = 5'000, d = random.integer(2, 3);
    const int shape = random.integer(0, 2);
    Points points(n, d);
    for (Index i = 0; i < n;) {
      const auto row = points.row(i);
      for (double& x : row) x = ties ? random.integer(-30, 30) / 30.0 : 2 * random.real() - 1;
      const double radius = std::hypot(row[0], row[1]);
      const double to_hole = std::hypot(std::abs(row[0]) - 0.5, std::abs(row[1]) - 0.5);
      if ((shape == 1 && (radius > 1 || radius < 0.7)) || (shape == 2 && to_hole < 0.3)) continue;
      ++i;
    }
    expect_same(points, {}, {.max_dim = 1, .field = field}, 2);
  });
}

// One hole lives long, and many holes are born after the death of others.
TEST(BetaSkeleton, HolesOfManySizes) {
  for_each_seed(60, [](Generator& random, bool, std::int64_t field) {
    const Index d = random.integer(2, 3), n = random.integer(150, 400);
    Points points(n, d);
    for (Index i = 0; i < n; ++i) {
      const double radius = std::pow(0.4, static_cast<double>(i % 4)), angle = 7 * random.real();
      points(i, 0) = 3 * static_cast<double>(i % 4) + radius * std::cos(angle);
      points(i, 1) = radius * std::sin(angle) * (1 + 0.05 * random.real());
      if (d == 3) points(i, 2) = 0.1 * random.real();
    }
    expect_same(points, {}, {.max_dim = 1, .field = field}, 2);
  });
}

// Many edges have nearly the same length, so their bins are split into narrower bins.
TEST(BetaSkeleton, RegularPolygons) {
  for (const Index n : {3, 6, 30, 300, 1'500}) {
    SCOPED_TRACE(n);
    Points points(n, 2);
    for (Index i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      points(i, 0) = std::cos(angle);
      points(i, 1) = std::sin(angle);
    }
    expect_same(points, {}, {.max_dim = 1, .field = 3}, 1);
  }
}

TEST(BetaSkeleton, Refuses) {
  const Points points{{0, 0}, {1, 0}, {0, 1}};
  const auto refused = [](const std::string& why, const Rips& rips, Options task = {}) {
    task.engine = Engine::beta_skeleton;
    const std::string what = "engine beta-skeleton: expected " + why;
    expect_error(ErrorKind::usage, what, [&] { plan(rips, task); });
    expect_error(ErrorKind::usage, what, [&] { persistence(rips, task); });
    expect_error(ErrorKind::usage, what, [&] { estimate(rips, task); });
  };
  refused("the Euclidean distance", Rips(points, {.distance = PointDistance::manhattan}));
  refused("points of 1 to 4 coordinates", Rips(Points(3, 5)));
  refused("vertices that all enter at 0", Rips(points, {.births = {0.0, 0.5, 1.0}}));
  refused("vertices that all enter at 0", Rips(points, {.dtm_neighbours = 2}));
  refused("the full filtration, not a sparse one", Rips(points, {.approximation = 0.5}));
  refused("coordinates that are 0 or between 1e-120", Rips(Points{{0, 1e-130}, {0, 0}}));
  const Rips distances(DistanceMatrix(2, std::vector<double>{1}));
  refused("points", distances);
  expect_error(ErrorKind::usage, "of distances", [&] { distances.graph(RipsForm::points); });
  const Rips rips(points);
  refused("dimensions 0 and 1 only", rips, {.max_dim = 2});
  refused("bars of positive length", rips, {.min_persistence = -1});
  refused("bars without representatives", rips, {.representatives = Representatives::cycles});
  refused("a task without an edge collapse", rips, {.collapse = Collapse::on});
  refused("points", Rips(RipsGraph::of_edges(3, {}, {}, default_context())));
  const RipsGraph& alone = rips.graph(RipsForm::points);
  with_rips_filtration(alone, 1, [&](const auto& f) {
    expect_error(ErrorKind::usage, "engine edge-links",
                 [&] { persistence(f, {.max_dim = 1, .engine = Engine::edge_links}); });
  });
  with_all_edges(rips, 1, [&](const auto& f) {
    expect_error(ErrorKind::usage, "engine beta-skeleton",
                 [&] { persistence(f, {.max_dim = 1, .engine = Engine::beta_skeleton}); });
  });
  expect_error(ErrorKind::usage, "needs edges", [&] { alone.edges(); });
  EXPECT_EQ(estimate(rips, {.engine = Engine::beta_skeleton}).options.engine,
            Engine::beta_skeleton);
}

TEST(BetaSkeleton, IsChosenWhereItPays) {
  const Options task{.max_dim = 1};
  Points many(6'000, 2);
  for (Index i = 0; i < many.rows(); ++i) many(i, 0) = static_cast<double>(i);
  const auto by_points = [](const Points& points, const RipsOptions& options,
                            const Options& wanted) {
    RunContext context;
    const RunPlan found = plan(Rips::borrowed(points, options, context), wanted, context);
    EXPECT_LT(context.memory.peak(), 100'000U) << "an edge was made";
    EXPECT_EQ(found.form == RipsForm::points, found.options.engine == Engine::beta_skeleton);
    return found.form == RipsForm::points;
  };
  EXPECT_TRUE(by_points(many, {}, task));
  EXPECT_FALSE(by_points(many, {}, {.max_dim = 2}));
  EXPECT_FALSE(by_points(many, {}, {.max_dim = 0}));
  EXPECT_FALSE(by_points(many, {.threshold = 5}, task));
  EXPECT_TRUE(by_points(many, {.threshold = 5'000}, task));
  EXPECT_FALSE(by_points(many, {}, {.representatives = Representatives::cycles}));
  EXPECT_FALSE(by_points(Points(100, 2), {}, task));
  EXPECT_TRUE(by_points(Points(100, 2), {}, {.engine = Engine::beta_skeleton}));
  EXPECT_FALSE(by_points(many, {}, {.engine = Engine::edge_links}));
  expect_error(ErrorKind::usage, "dimensions 0 and 1 only",
               [&] { by_points(many, {}, {.max_dim = 2, .engine = Engine::beta_skeleton}); });
}

TEST(BetaSkeleton, EndsAtTheMemoryLimitAndOnRequest) {
  Generator random(1);
  const Points points = random.points(20'000, 3, false);
  RunContext context;
  const Rips rips(points, {}, context);
  const Options task{.engine = Engine::beta_skeleton};
  rips.graph(RipsForm::points, context);
  context.memory.set_limit(context.memory.used() + 200'000);
  expect_error(ErrorKind::resource, "", [&] { persistence(rips, task, context); });
  StoppedContext stopped;
  expect_error(ErrorKind::cancelled, "", [&] { persistence(rips, task, stopped); });
}

}  // namespace
}  // namespace ph::test
