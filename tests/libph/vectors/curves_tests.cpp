// SPDX-License-Identifier: MIT
// Grids, the treatment of infinite bars, and curves on grids.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "libph/src/vectors/grid_cells.hpp"
#include "ph/vectorise.hpp"
#include "tests/libph/vectors/bars_by_definition.hpp"
#include "tests/support/expect_error.hpp"

namespace ph {
namespace {

using test::Bars;
using test::expect_error;
using test::random_bars;
using Spans = std::vector<std::span<const Bar>>;

TEST(Grids, HaveBothEndsAndEqualSteps) {
  EXPECT_EQ((Grid{0, 1, 5}.values()), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ((Grid{-3, 3, 2}.values()), (std::vector<double>{-3, 3}));
  EXPECT_EQ((Grid{2, 3, 1}.values()), (std::vector<double>{2}));
  const std::vector<double> tenths = Grid{0, 0.1, 4}.values();  // the values of numpy.linspace
  EXPECT_EQ(tenths[1], 1 * (0.1 / 3));
  EXPECT_EQ(tenths[2], 2 * (0.1 / 3));
  EXPECT_EQ(tenths[3], 0.1);
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const double lo = std::uniform_real_distribution<>(-1, 0)(random);
    const double hi = std::uniform_real_distribution<>(0.01, 1)(random);
    const std::vector<double> values = Grid{lo, hi, 2 + random() % 300}.values();
    ASSERT_EQ(values.front(), lo);
    ASSERT_EQ(values.back(), hi);
    ASSERT_TRUE(std::ranges::is_sorted(values));
  }
}

TEST(Grids, AreFittedToBatches) {
  const Bars a = {{0, 1, 3}, {0, -kInfinity, 2}}, b = {{1, 0.5, kInfinity}}, none,
             one = {{0, 4, 4}};
  EXPECT_EQ(fit_grid(Spans{a, b}, 7), (Grid{0.5, 3, 7}));
  EXPECT_EQ(fit_grid(Spans{none}, 7), (Grid{0, 1, 7}));
  EXPECT_EQ(fit_grid(Spans{}), (Grid{0, 1, 100}));
  EXPECT_EQ(fit_grid(Spans{one}), (Grid{0, 1, 100}));  // no curve counts such a bar
  const Bars end = {{0, 4, kInfinity}}, large = {{0, 1e15, kInfinity}};
  EXPECT_EQ(fit_grid(Spans{end, one}), (Grid{3.5, 4.5, 100}));
  EXPECT_LT(fit_grid(Spans{large}).lo, 1e15);
  const Bars c = {{0, 1, 3}, {0, 2, 2.5}};
  EXPECT_EQ(fit_image_frame(Spans{c, one}, 3, 4), (ImageFrame{{1, 2, 3}, {0, 2, 4}}));
  EXPECT_EQ(fit_image_frame(Spans{one}, 3, 4), (ImageFrame{{0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(fit_image_frame(Spans{Bars{{0, 5, 7}}}, 3, 4), (ImageFrame{{4, 6, 3}, {0, 2, 4}}));
}

// The position of a value on a grid is first estimated. Even if the estimate is wrong, the result
// equals the result of a search.
TEST(Grids, PlacesAreThoseOfASearch) {
  std::mt19937 random(1);
  const Grid grids[] = {
      {0, 1, 100},     {-1, 1, 7},         {0, 0.1, 1000}, {1e16, 1e16 + 64, 100}, {0, 5e-324, 2},
      {0, 1e-310, 50}, {-1e100, 1e100, 9}, {3, 3, 1},      {1, 1 + 1e-15, 4}};
  for (const Grid& grid : grids) {
    const vectors::GridCells cells(grid, "test");
    const auto& values = cells.values();
    std::vector<double> numbers = {-kInfinity, kInfinity, 0, grid.lo, grid.hi, -1e100, 1e100};
    for (const double t : values)
      for (const double to : {-kInfinity, kInfinity}) {
        numbers.push_back(t);
        numbers.push_back(std::nextafter(t, to));
      }
    for (int i = 0; i < 100; ++i)
      numbers.push_back(std::uniform_real_distribution<>(grid.lo - 1, grid.hi + 1)(random));
    for (const double x : numbers) {
      const auto expected = std::ranges::lower_bound(values, x) - values.begin();
      ASSERT_EQ(cells.first_from(x), static_cast<std::size_t>(expected)) << x << " of " << grid.lo;
    }
    for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
      const auto [low, high] = std::minmax({numbers[i], numbers[i + 1]});
      const Bar bar{0, low, high};
      if (!(std::isfinite(low) && low < high)) continue;
      const auto falls = std::ranges::find_if(values, [&](double t) { return high - t < t - low; });
      ASSERT_EQ(cells.first_falling(bar), static_cast<std::size_t>(falls - values.begin()))
          << low << " " << high << " of " << grid.lo;
    }
  }
}

TEST(InfiniteBars, AreDroppedCappedOrRefused) {
  using Rule = InfiniteBars::Rule;
  const Bars bars = {{0, 0, kInfinity}, {0, 1, 2}, {1, 3, 3}, {0, -kInfinity, 4}};
  const FiniteBars dropped = finite_bars(bars);
  EXPECT_EQ(dropped.bars, (Bars{{0, 1, 2}, {1, 3, 3}}));
  EXPECT_EQ(dropped.dropped, 2U);
  const std::span<const Bar> few = std::span(bars).first(3);
  const FiniteBars capped = finite_bars(few, {Rule::cap, 5});
  EXPECT_EQ(capped.bars, (Bars{{0, 0, 5}, {0, 1, 2}, {1, 3, 3}}));
  EXPECT_EQ(capped.dropped, 0U);
  EXPECT_EQ(finite_bars(few, {Rule::cap, 0}).bars[0], (Bar{0, 0, 0}));
  EXPECT_EQ(finite_bars(std::span(bars).subspan(1, 2), {Rule::refuse}).bars.size(), 2U);
  expect_error(ErrorKind::bad_data, "found a bar [0, inf)",
               [&] { finite_bars(few, {Rule::refuse}); });
  expect_error(ErrorKind::bad_data, "a cap replaces only infinite deaths", [&] {
    finite_bars(bars, {Rule::cap, 9});
  });
  expect_error(ErrorKind::usage, "found -1, expected at least 0", [&] {
    finite_bars(few, {Rule::cap, -1});
  });
  expect_error(ErrorKind::usage, "cap: found inf", [&] {
    finite_bars(few, {Rule::cap, kInfinity});
  });
  expect_error(ErrorKind::bad_data, "found a bar [2, 1)", [&] { finite_bars(Bars{{0, 2, 1}}); });
}

constexpr Grid kGrids[] = {{-1, 1, 50}, {0, 12, 13}, {-0.3, 0.2, 7}, {0.5, 0.5, 1}, {-5, 20, 101}};

TEST(Curves, AreTheirDefinitions) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 4 : 12;
    const Bars bars = random_bars(random, random() % 40, steps);
    const Grid grid = kGrids[random() % std::size(kGrids)];
    const double power = std::vector<double>{0, 1, 0.5, 3}[random() % 4];
    std::vector<double> betti(grid.points, -1), life = betti, shape = betti;
    betti_curve(bars, grid, betti);
    life_entropy_curve(bars, grid, life);
    silhouette(bars, grid, power, shape);
    const std::vector<double> values = grid.values();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double t = values[i];
      const auto lives = [t](const Bar& bar) { return bar.birth <= t && t < bar.death; };
      ASSERT_EQ(betti[i], static_cast<double>(std::ranges::count_if(bars, lives))) << round;
      ASSERT_NEAR(life[i], test::entropy_of(bars, lives), 1e-14) << round;
      const double expected = test::silhouette_at(bars, power, t);
      ASSERT_NEAR(shape[i], expected, 1e-14 * (1 + steps)) << round;
      if (expected == 0) {
        ASSERT_LE(shape[i], 1e-15 * (1 + steps));
      }
      if (betti[i] == 0) {
        ASSERT_EQ(life[i], 0) << round;  // the added values cancel exactly
        ASSERT_EQ(shape[i], 0) << round;
      }
    }
  }
}

TEST(Curves, OfKnownBars) {
  const Bars bars = {{0, 0, 2}, {0, 1, kInfinity}, {0, -kInfinity, 0}, {0, -kInfinity, kInfinity}};
  const Grid grid{-1, 2, 4};
  std::vector<double> out(4);
  betti_curve(bars, grid, out);
  EXPECT_EQ(out, (std::vector<double>{2, 2, 3, 2}));
  silhouette(Bars{{0, 0, 2}}, grid, 7, out);
  EXPECT_EQ(out, (std::vector<double>{0, 0, 1, 0}));
  life_entropy_curve(Bars{{0, 0, 2}, {0, 1, 3}}, grid, out);
  const double half = 0.5 * std::log(2);
  EXPECT_EQ(out, (std::vector<double>{0, half, 2 * half, half}));
  for (double& x : out) x = 5;
  silhouette({}, grid, 1, out);
  EXPECT_EQ(out, std::vector<double>(4));
}

// The bars are far from 0 and have very different lengths. Sums must keep the contribution of the
// short bars.
TEST(Curves, KeepSmallBarsBesideLargeOnes) {
  const Bars bars = {{0, 1000, 1001}, {0, 1000.25, 1000.25 + 0x1p-20}};
  const Grid grid{1000, 1001, 4097};
  std::vector<double> shape(grid.points);
  silhouette(bars, grid, 0, shape);
  const std::vector<double> values = grid.values();
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_NEAR(shape[i], test::silhouette_at(bars, 0, values[i]), 1e-15);
  const Bars scaled = {{0, -1e100, 1e100}, {0, 0, 1e-100}};
  std::vector<double> out(3);
  silhouette(scaled, {-1e100, 1e100, 3}, 4, out);  // fourth powers of the lengths would overflow
  EXPECT_EQ(out, (std::vector<double>{0, 1e100, 0}));
}

TEST(Curves, RefuseWhatMakesNoSense) {
  const Bars one = {{0, 1, 5}}, endless = {{0, 1, kInfinity}};
  const Grid grid{0, 1, 10};
  std::vector<double> out(10), small(9);
  const double nan = std::nan("");
  expect_error(ErrorKind::usage, "found room for 9 numbers, expected 10",
               [&] { betti_curve(one, grid, small); });
  expect_error(ErrorKind::usage, "power: found -1", [&] { silhouette(one, grid, -1, out); });
  expect_error(ErrorKind::usage, "power: found nan", [&] { silhouette(one, grid, nan, out); });
  for (const Grid& wrong :
       {Grid{0, 0, 2}, Grid{1, 0, 10}, Grid{0, nan, 10}, Grid{0, kInfinity, 10}, Grid{0, 1, 0}})
    expect_error(ErrorKind::usage, "grid: found", [&] { betti_curve(one, wrong, out); });
  expect_error(ErrorKind::bad_data, "silhouette: found a bar [1, inf)",
               [&] { silhouette(endless, grid, 1, out); });
  expect_error(ErrorKind::bad_data, "life_entropy_curve: found a bar [1, inf)",
               [&] { life_entropy_curve(endless, grid, out); });
  expect_error(ErrorKind::bad_data, "choose a larger unit", [&] {
    betti_curve(Bars{{0, 0, 2e100}}, grid, out);
  });
  expect_error(ErrorKind::bad_data, "found a bar [nan, 1)", [&] {
    betti_curve(Bars{{0, nan, 1}}, grid, out);
  });
  expect_error(ErrorKind::usage, "found 0 points", [&] { fit_grid(Spans{one}, 0); });
  expect_error(ErrorKind::usage, "found 0 × 1 pixels", [&] { fit_image_frame(Spans{one}, 1, 0); });
}

}  // namespace
}  // namespace ph
