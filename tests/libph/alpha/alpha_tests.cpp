// SPDX-License-Identifier: MIT
// Alpha complexes: compares their own engine with the oracle for any filtration, and checks
// properties that hold for any points.
#include "ph/alpha.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>

#include "ph/detail/facade/adjust.hpp"
#include "ph/detail/facade/alpha_engines.hpp"
#include "tests/libph/alpha/alpha_oracle.hpp"
#include "tests/libph/alpha/alpha_support.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/representatives.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

Points in_order(const Points& points, std::span<const Index> order) {
  Points result(static_cast<Index>(order.size()), points.cols());
  for (Index i = 0; i < result.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k)
      result(i, k) = points(order[static_cast<std::size_t>(i)], k);
  return result;
}

TEST(Alpha, EveryEngineFindsTheBarsOfTheOracle) {
  for_each_seed(200, [](Generator& random, bool weighted, std::int64_t field) {
    const Cloud cloud = any_cloud(random, 30, weighted);
    SCOPED_TRACE(cloud.name);
    const Alpha alpha(cloud.points, cloud.options());
    ASSERT_NO_FATAL_FAILURE(check_contract(alpha, alpha.top_dim(), field));
    const Barcode oracle = persistence(alpha, {.field = field, .engine = Engine::standard});
    for (const auto& engine : detail::engines<Alpha>()) {
      if (!engine.can_run(alpha, {.max_dim = alpha.top_dim()})) continue;
      SCOPED_TRACE(engine.id.name());
      EXPECT_EQ(first_difference(persistence(alpha, {.field = field, .engine = engine.id}), oracle),
                "");
    }
    // Compares the result if fewer dimensions are requested.
    for (int dim = 0; dim <= 2; ++dim) {
      const Barcode part = persistence(
          alpha, {.max_dim = dim, .min_dim = dim, .field = field, .engine = Engine::gradient});
      EXPECT_TRUE(std::ranges::equal(part, oracle.bars(dim)));
    }
  });
}

// If no two intervals have the same value, the pairs are equal cell by cell.
TEST(Alpha, CellsAreThoseOfTheOracle) {
  for_each_seed(40, [](Generator& random, bool weighted, std::int64_t field) {
    Cloud cloud{"", random.points(25, random.integer(2, 3), false), {}};
    for (Index i = 0; weighted && i < 25; ++i) cloud.weights.push_back(random.real() / 8);
    check(Alpha(cloud.points, cloud.options()), 3, {field});
  });
}

TEST(Alpha, CyclesAreCycles) {
  for_each_seed(30, [](Generator& random, bool weighted, std::int64_t field) {
    const Index dim = random.integer(2, 3);
    Cloud cloud{"", random.points(25, dim, false), {}};
    for (Index i = 0; weighted && i < 25; ++i) cloud.weights.push_back(random.real() / 8);
    const Alpha alpha(cloud.points, cloud.options());
    const OrderedCells<Alpha> cells(alpha, alpha.top_dim(), field);
    const Barcode bars = persistence(
        alpha,
        {.field = field, .engine = Engine::gradient, .representatives = Representatives::cycles});
    for (std::size_t i = 0; i < bars.size(); ++i)
      ASSERT_NO_FATAL_FAILURE(check_cycle(cells, bars, i)) << "bar " << i;
  });
}

// With ties, the bars may name other cells than the oracle does. Each representative must still be
// a cycle that is born at the birth of its bar.
TEST(Alpha, CyclesAmongTies) {
  for_each_seed(60, [](Generator& random, bool weighted, std::int64_t field) {
    const Cloud cloud = any_cloud(random, 25, weighted);
    SCOPED_TRACE(cloud.name);
    const Alpha alpha(cloud.points, cloud.options());
    const OrderedCells<Alpha> cells(alpha, alpha.top_dim(), field);
    const Barcode bars = persistence(
        alpha,
        {.field = field, .engine = Engine::gradient, .representatives = Representatives::cycles});
    for (std::size_t i = 0; i < bars.size(); ++i) {
      const Bar& bar = bars[i];
      const PositionChain cycle = closed_cycle(cells, bars, i);
      const auto of_dim = sorted_cells(alpha, bar.dim);
      ASSERT_FALSE(cycle.empty());
      EXPECT_EQ(alpha.value(of_dim[cycle.rbegin()->first]), bar.birth);
      const auto above = sorted_cells(alpha, bar.dim + 1);
      const auto before = [&](auto&& is_in) {
        return static_cast<std::size_t>(
            std::ranges::count_if(above, [&](const auto& c) { return is_in(alpha.value(c)); }));
      };
      EXPECT_FALSE(
          cells.is_boundary(cycle, bar.dim, before([&](double v) { return v < bar.death; })));
      if (bar.is_infinite()) continue;
      EXPECT_TRUE(
          cells.is_boundary(cycle, bar.dim, before([&](double v) { return v <= bar.death; })));
    }
  });
}

TEST(Alpha, OrderOfPointsIsIrrelevant) {
  for_each_seed(60, [](Generator& random, bool weighted, std::int64_t) {
    Cloud cloud = any_cloud(random, 40, weighted);
    SCOPED_TRACE(cloud.name);
    const Barcode bars = persistence(Alpha(cloud.points, cloud.options()));
    std::vector<Index> order(static_cast<std::size_t>(cloud.points.rows()));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1],
                order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    Cloud other{"", in_order(cloud.points, order), {}};
    if (weighted)
      for (const Index i : order)
        other.weights.push_back(cloud.weights[static_cast<std::size_t>(i)]);
    EXPECT_EQ(first_difference(persistence(Alpha(other.points, other.options())), bars), "");
  });
}

TEST(Alpha, UnitsArePowersOfTwoExactly) {
  const Points points = uniform_points(300, 3, 1);
  const Barcode bars = persistence(Alpha(points));
  for (const int power : {-500, -3, 7, 500}) {
    const double unit = std::ldexp(1.0, power);
    const Barcode scaled = persistence(Alpha(times(points, unit)));
    ASSERT_EQ(scaled.size(), bars.size());
    for (std::size_t i = 0; i < bars.size(); ++i)
      ASSERT_EQ(scaled[i], (Bar{bars[i].dim, bars[i].birth * unit, bars[i].death * unit}));
  }
}

TEST(Alpha, TranslationOfAGridIsExact) {
  Points grid(125, 3), moved(125, 3);
  for (Index i = 0; i < 125; ++i)
    for (Index k = 0; k < 3; ++k) {
      grid(i, k) = static_cast<double>(i / (k == 0 ? 25 : k == 1 ? 5 : 1) % 5);
      moved(i, k) = grid(i, k) + 1000 * static_cast<double>(k + 1);
    }
  const Barcode bars = persistence(Alpha(grid));
  EXPECT_EQ(first_difference(persistence(Alpha(moved)), bars), "");
  // 124 edges merge components at ½. The other 12·25 − 124 edges create loops, which squares fill
  // at √½. Cubes fill 64 voids at √¾.
  EXPECT_EQ(bars.bars(0).size(), 125U);
  EXPECT_EQ(bars.bars(1).size(), 176U);
  EXPECT_EQ(bars.bars(2).size(), 64U);
  for (const Bar& bar : bars.bars(1)) EXPECT_EQ(bar, (Bar{1, 0.5, std::sqrt(0.5)}));
  for (const Bar& bar : bars.bars(2)) EXPECT_EQ(bar, (Bar{2, std::sqrt(0.5), std::sqrt(0.75)}));
}

TEST(Alpha, ComponentsAreThoseOfHalfTheDistances) {
  for (const Index dim : {1, 2, 3}) {
    const Points points = uniform_points(500, dim, 3);
    const Barcode alpha = persistence(Alpha(points), {.max_dim = 0});
    const Barcode rips = persistence(Rips(points), {.max_dim = 0});
    ASSERT_EQ(alpha.size(), rips.size());
    for (std::size_t i = 0; i < alpha.size(); ++i) EXPECT_EQ(2 * alpha[i].death, rips[i].death);
  }
}

TEST(Alpha, PlanesAndLinesInSpace) {
  const Points plane = uniform_points(200, 2, 4), line = uniform_points(50, 1, 5);
  Points in_space(200, 3), on_line(50, 3);
  for (Index i = 0; i < 200; ++i) {  // the plane, rotated in space without rounding
    in_space(i, 1) = plane(i, 0);
    in_space(i, 2) = plane(i, 1);
  }
  for (Index i = 0; i < 50; ++i) on_line(i, 2) = line(i, 0);
  const auto is_near = [](const Barcode& a, const Barcode& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].dim, b[i].dim);
      EXPECT_NEAR(a[i].birth, b[i].birth, 1e-14);
      if (!b[i].is_infinite()) {
        EXPECT_NEAR(a[i].death, b[i].death, 1e-12);
      }
    }
  };
  const Alpha alpha(in_space);
  EXPECT_EQ(alpha.top_dim(), 2);
  is_near(persistence(alpha), persistence(Alpha(plane)));
  EXPECT_EQ(Alpha(on_line).top_dim(), 1);
  is_near(persistence(Alpha(on_line)), persistence(Alpha(line)));
}

TEST(Alpha, FewPoints) {
  EXPECT_EQ(Alpha(Points(0, 3)).top_dim(), -1);
  EXPECT_TRUE(persistence(Alpha(Points(0, 3))).empty());
  for (const Index dim : {1, 2, 3}) {
    const Barcode one = persistence(Alpha(Points(1, dim)));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0], (Bar{0, 0, kInfinity}));
  }
  const Barcode two = persistence(Alpha(Points{{0, 0}, {0, 6}}));
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0], (Bar{0, 0, 3}));
  ASSERT_TRUE(two.death_cell(0));
  EXPECT_EQ(two.death_cell(0)->numbers.size(), 2U);
}

TEST(Alpha, CopiesJoinAtZero) {
  const Points once = uniform_points(60, 3, 6);
  Points thrice(180, 3);
  for (Index i = 0; i < 180; ++i)
    for (Index k = 0; k < 3; ++k) thrice(i, k) = once(i % 60, k);
  const Alpha alpha(thrice);
  EXPECT_EQ(first_difference(persistence(alpha), persistence(Alpha(once))), "");
  EXPECT_EQ(alpha.copies().size(), 120U);
  EXPECT_EQ(alpha.copies().front(), 60);
  EXPECT_EQ(alpha.simplex_counts()[0], 180U);
  const Barcode all = persistence(alpha, {.max_dim = 0, .min_persistence = -1});
  EXPECT_EQ(std::ranges::count(all, Bar{0, 0, 0}), 120);
  const Alpha same(Points(5, 2));
  EXPECT_EQ(same.top_dim(), 1);
  EXPECT_EQ(persistence(same).size(), 1U);
}

TEST(Alpha, HiddenPointsAreNamed) {
  // Let x be the first coordinate of a place. For x up to 7.25, the power with respect to the first
  // point is less than with respect to the second. For x above 4.67, the power with respect to the
  // third point is less than both.
  const Alpha alpha(Points{{0, 0, 0}, {0.5, 0, 0}, {9, 0, 0}, {0, 0, 0}},
                    {.weights = {4, -3, 1, 3}, .unit = AlphaOptions::Unit::squared});
  EXPECT_EQ(std::vector<std::uint32_t>(alpha.hidden().begin(), alpha.hidden().end()),
            (std::vector<std::uint32_t>{1, 3}));
  const Barcode bars = persistence(alpha);
  ASSERT_EQ(bars.size(), 2U);
  EXPECT_EQ(bars[0].birth, -4);
  EXPECT_EQ(bars[1].birth, -1);
}

TEST(Alpha, EqualWeightsShiftSquares) {
  const Points points = uniform_points(150, 3, 7);
  const auto squared = AlphaOptions::Unit::squared;
  const Barcode plain = persistence(Alpha(points, {.unit = squared}));
  const Barcode shifted =
      persistence(Alpha(points, {.weights = std::vector<double>(150, 0.25), .unit = squared}));
  ASSERT_EQ(shifted.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(shifted[i].birth, plain[i].birth - 0.25, 1e-14);
    if (!plain[i].is_infinite()) {
      EXPECT_NEAR(shifted[i].death, plain[i].death - 0.25, 1e-12 * (1 + plain[i].death));
    }
  }
}

TEST(Alpha, Threshold) {
  for_each_seed(60, [](Generator& random, bool weighted, std::int64_t) {
    const Cloud cloud = any_cloud(random, 25, weighted);
    const Barcode all = persistence(Alpha(cloud.points, cloud.options()));
    AlphaOptions options = cloud.options();
    options.threshold =
        all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))].death;
    if (options.threshold == kInfinity) options.threshold = random.real();
    const Alpha alpha(cloud.points, options);
    const Barcode engine = persistence(alpha);
    EXPECT_EQ(first_difference(engine, persistence(alpha, {.engine = Engine::standard})), "");
    int top = -1;
    for (int dim = 0; dim <= 3; ++dim) alpha.for_each_cell(dim, [&](const auto&) { top = dim; });
    EXPECT_EQ(alpha.top_dim(), top);
  });
}

// The radius of the smallest ball around the points. This ball is the smallest ball through a
// subset of the points that contains all of them.
double smallest_ball(const Points& points, const std::vector<Index>& simplex) {
  const AlphaOracle oracle(in_order(points, simplex), {});
  double least = kInfinity;
  for (const auto& [centre, squared] : oracle.centres()) {
    double farthest = 0;
    for (const Index v : simplex) {
      double sum = 0;
      for (Index k = 0; k < points.cols(); ++k)
        sum += (points(v, k) - centre[static_cast<std::size_t>(k)]) *
               (points(v, k) - centre[static_cast<std::size_t>(k)]);
      farthest = std::max(farthest, sum);
    }
    if (farthest <= squared * (1 + 1e-12)) least = std::min(least, farthest);
  }
  return least;
}

TEST(Alpha, OtherValues) {
  for_each_seed(40, [](Generator& random, bool ties, std::int64_t) {
    const Points points = random.points(20, random.integer(2, 3), ties);
    AlphaOptions options{.unit = AlphaOptions::Unit::squared};
    const Barcode alpha = persistence(Alpha(points, options));
    options.value = AlphaOptions::Value::delaunay_cech;
    const Alpha cech(points, options);
    for (int dim = 1; dim <= cech.top_dim(); ++dim)
      cech.for_each_cell(dim, [&](const Alpha::Cell& cell) {
        std::vector<Index> simplex;
        cech.append_input_cell(dim, cell, simplex);
        EXPECT_NEAR(cech.value(cell), smallest_ball(points, simplex), 1e-10);
      });
    // If values are tied, rounding may create bars that are no longer than the rounding errors.
    const auto lasting = [](const Barcode& bars) {
      std::vector<Bar> result(bars.begin(), bars.end());
      std::erase_if(result, [](const Bar& b) { return b.persistence() < 1e-9; });
      return result;
    };
    const auto a = lasting(alpha), b = lasting(persistence(cech));
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].birth, b[i].birth, 1e-9);
    options.value = AlphaOptions::Value::delaunay_rips;
    const Alpha rips(points, options);
    for (int dim = 1; dim <= rips.top_dim(); ++dim)
      rips.for_each_cell(dim, [&](const Alpha::Cell& cell) {
        std::vector<Index> simplex;
        rips.append_input_cell(dim, cell, simplex);
        double longest = 0;
        for (const Index u : simplex)
          for (const Index v : simplex) {
            double sum = 0;
            for (Index k = 0; k < points.cols(); ++k)
              sum += (points(u, k) - points(v, k)) * (points(u, k) - points(v, k));
            longest = std::max(longest, sum);
          }
        EXPECT_NEAR(rips.value(cell), longest / 4, 1e-14);
      });
    EXPECT_EQ(first_difference(persistence(rips), persistence(rips, {.engine = Engine::standard})),
              "");
  });
  AlphaOptions weighted{.weights = {1, 1}, .value = AlphaOptions::Value::delaunay_rips};
  weighted.unit = AlphaOptions::Unit::squared;
  expect_error(ErrorKind::usage, "found delaunay-rips values",
               [&] { Alpha(Points(2, 2), weighted); });
}

TEST(Alpha, ThreadsChangeNothing) {
  for (const bool weighted : {false, true}) {
    const Points points = uniform_points(30'000, 3, 8);
    AlphaOptions options{.unit = AlphaOptions::Unit::squared};
    Generator random(9);
    for (Index i = 0; weighted && i < points.rows(); ++i)
      options.weights.push_back(random.real() * 1e-3);
    std::optional<Barcode> first;
    for (const int threads : {1, 2, 3, 8}) {
      ThreadsContext context(threads);
      const Barcode bars = persistence(
          Alpha(points, options, context),
          {.min_persistence = 2e-4, .representatives = Representatives::cycles}, context);
      if (!first) {
        first = bars;
        EXPECT_GT(bars.size(), 1000U);
        continue;
      }
      ASSERT_EQ(pairs_of(bars), pairs_of(*first));
      for (std::size_t i = 0; i < bars.size(); ++i) {
        const InputChain a = bars.representative(i), b = first->representative(i);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k)
          ASSERT_TRUE(std::ranges::equal(a.cell(k).numbers, b.cell(k).numbers));
      }
    }
  }
}

TEST(Alpha, Refusals) {
  expect_error(ErrorKind::usage, "R^4", [] { Alpha(Points(3, 4)); });
  expect_error(ErrorKind::usage, "one for each of 3 points", [] {
    Alpha(Points(3, 2), {.weights = {1, 2}, .unit = AlphaOptions::Unit::squared});
  });
  expect_error(ErrorKind::usage, "squared", [] { Alpha(Points(2, 2), {.weights = {1, 2}}); });
  expect_error(ErrorKind::usage, "threshold",
               [] { Alpha(Points(2, 2), {.threshold = std::nan("")}); });
  expect_error(ErrorKind::bad_data, "point 1, coordinate 0", [] {
    Alpha(Points{{0, 0}, {kInfinity, 0}});
  });
  expect_error(ErrorKind::bad_data, "weight of point 1", [] {
    Alpha(Points{{0, 0}, {1, 0}},
          {.weights = {0, std::nan("")}, .unit = AlphaOptions::Unit::squared});
  });
  expect_error(ErrorKind::usage, "collapse",
               [] { persistence(Alpha(Points(2, 2)), {.collapse = Collapse::on}); });
}

TEST(Alpha, StopsAndKeepsToItsMemory) {
  const Points points = uniform_points(20'000, 3, 10);
  StoppableContext context;
  std::vector<std::string> stages;
  context.on_progress = [&](const Progress& p) { stages.emplace_back(p.stage); };
  const Alpha alpha(points, {}, context);
  EXPECT_FALSE(stages.empty());
  context.request_stop();
  expect_error(ErrorKind::cancelled, "", [&] { Alpha(points, {}, context); });
  expect_error(ErrorKind::cancelled, "", [&] { persistence(alpha, {}, context); });
  LimitedContext small(10 << 20);
  expect_error(ErrorKind::resource, "memory limit", [&] { Alpha(points, {}, small); });
  EXPECT_EQ(small.memory.used(), 0U);
  // CGAL's memory counts as well. In the plane, it is the larger part.
  RunContext of_plane;
  Alpha(uniform_points(20'000, 2, 11), {}, of_plane);
  EXPECT_GT(of_plane.memory.peak(), 20'000U * 200);
}

TEST(Alpha, BarsStateTheirOrigin) {
  const std::vector<double> square{0, 0, 1, 0, 1, 1, 0, 1};
  const PointsView points(square.data(), 4, 2);
  const BarcodeInfo plain = persistence(Alpha(points, {.threshold = 2})).info();
  EXPECT_EQ(plain.complex, "alpha");
  EXPECT_EQ(plain.points, 4);
  EXPECT_EQ(plain.coordinates, 2);
  EXPECT_EQ(plain.threshold, 2);
  const BarcodeInfo torus = persistence(Alpha(points, {.period = {4, 0}})).info();
  ASSERT_TRUE(torus.alpha);
  EXPECT_EQ(torus.alpha->period, (std::vector<double>{4, 0}));
  // Three large balls hide the last point, which lies between them.
  const std::vector<double> triangle{0, 0, 4, 0, 0, 4, 1, 1};
  const Alpha weighted(PointsView(triangle.data(), 4, 2),
                       {.weights = {9, 9, 9, 0}, .unit = AlphaOptions::Unit::squared});
  const Barcode bars = persistence(weighted);
  EXPECT_EQ(bars.info().vertex_weights, "squared radii of balls, given");
  ASSERT_TRUE(bars.info().alpha);
  EXPECT_EQ(bars.info().alpha->hidden, (std::vector<Index>{3}));
  EXPECT_EQ(with_input_ids(bars, {0, 2, 3, 7}).info().alpha->hidden, (std::vector<Index>{7}));
}

}  // namespace
}  // namespace ph::test
