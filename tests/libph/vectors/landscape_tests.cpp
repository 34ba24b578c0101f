// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <string>

#include "ph/error.hpp"
#include "ph/vectorise.hpp"
#include "tests/libph/vectors/bars_by_definition.hpp"
#include "tests/support/expect_error.hpp"

namespace ph {
namespace {

using test::Bars;
using test::expect_error;
using test::random_bars;

TEST(Landscapes, OnAGridAreTheirDefinitionToTheLastBit) {
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round) {
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 5 : 20;
    Bars bars = random_bars(random, random() % 30, steps);
    for (Bar& bar : bars)
      if (random() % 8 == 0) bar.death = kInfinity;
    const std::size_t layers = 1 + random() % 6;
    const Grid grids[] = {{-1, 1, 37}, {0, 20, 21}, {0.1, 0.3, 5}, {2, 2, 1}, {-30, 60, 200}};
    const Grid grid = grids[random() % std::size(grids)];
    std::vector<double> out(layers * grid.points, -1);
    landscape(bars, grid, layers, out);
    const std::vector<double> values = grid.values();
    for (std::size_t k = 0; k < layers; ++k)
      for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(out[k * grid.points + i], test::landscape_at(bars, k, values[i]))
            << round << ": layer " << k << " at " << values[i];
  }
}

TEST(Landscapes, AreExactAtAllValues) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 5 : 30;
    const Bars bars = random_bars(random, random() % 25, steps);
    const std::size_t layers = round % 4 == 0 ? 2 : 1000;
    const std::vector<PiecewiseLinear> found = exact_landscape(bars, layers);
    ASSERT_LE(found.size(), layers);
    double areas = 0, expected_areas = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const PiecewiseLinear& layer = found[k];
      ASSERT_EQ(layer.at.size(), layer.value.size());
      ASSERT_TRUE(std::ranges::is_sorted(layer.at, std::less_equal<>())) << round;
      ASSERT_GT(*std::ranges::max_element(layer.value), 0) << round;
      ASSERT_EQ(layer.value.front(), 0);
      ASSERT_EQ(layer.value.back(), 0);
      for (std::size_t i = 0; i < layer.at.size(); ++i) {
        ASSERT_NEAR(layer.value[i], test::landscape_at(bars, k, layer.at[i]), 1e-14 * (1 + steps))
            << round << ": layer " << k;
        if (i > 0)
          areas += (layer.at[i] - layer.at[i - 1]) * (layer.value[i] + layer.value[i - 1]) / 2;
      }
      for (double t = -1.1; t < 1.1 + steps; t += 0.0371) {
        ASSERT_NEAR(layer(t), test::landscape_at(bars, k, t), 1e-14 * (1 + steps))
            << round << ": layer " << k << " at " << t;
      }
    }
    if (layers < 1000) continue;
    // All layers together cover all tents: no tent is lost.
    for (const Bar& bar : bars) expected_areas += bar.persistence() * bar.persistence() / 4;
    ASSERT_NEAR(areas, expected_areas, 1e-12 * (1 + expected_areas)) << round;
  }
}

TEST(Landscapes, OfKnownBars) {
  const Bars bars = {{0, 0, 4}, {0, 2, 6}, {0, 2, 6}};
  const std::vector<PiecewiseLinear> found = exact_landscape(bars, 9);
  ASSERT_EQ(found.size(), 3U);
  using Numbers = std::vector<double>;
  EXPECT_EQ(found[0].at, (Numbers{0, 2, 3, 4, 6}));
  EXPECT_EQ(found[0].value, (Numbers{0, 2, 1, 2, 0}));
  EXPECT_EQ(found[1].at, (Numbers{2, 4, 6}));
  EXPECT_EQ(found[2].at, (Numbers{2, 3, 4}));
  EXPECT_EQ(found[2].value, (Numbers{0, 1, 0}));
  EXPECT_EQ(found[2](2.5), 0.5);
  EXPECT_EQ(found[2](1.5), 0);
  EXPECT_EQ(found[2](4.5), 0);
  EXPECT_EQ(exact_landscape(Bars{{0, 0, 1}, {0, 1, 2}, {0, 5, 7}}, 1)[0].at,
            (Numbers{0, 0.5, 1, 1.5, 2, 5, 6, 7}));
  EXPECT_TRUE(exact_landscape({}, 3).empty());
  EXPECT_TRUE(exact_landscape(Bars{{0, 1, 1}}, 3).empty());
  Numbers out(2 * 3, -1);
  landscape({}, {0, 1, 3}, 2, out);
  EXPECT_EQ(out, Numbers(6));
  landscape(Bars{{0, 1, kInfinity}}, {0, 4, 3}, 2, out);
  EXPECT_EQ(out, (Numbers{0, 1, 3, 0, 0, 0}));
}

TEST(Landscapes, OfManyCopies) {
  const Bars copies(100'000, {0, 0, 2});
  std::vector<double> out(3 * 5);
  landscape(copies, {0, 2, 5}, 3, out);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ((std::vector<double>(out.begin() + static_cast<std::ptrdiff_t>(5 * k),
                                   out.begin() + static_cast<std::ptrdiff_t>(5 * k + 5))),
              (std::vector<double>{0, 0.5, 1, 0.5, 0}));
  EXPECT_EQ(exact_landscape(copies, 4)[3].at, (std::vector<double>{0, 1, 2}));
}

TEST(Landscapes, RefuseWhatMakesNoSenseAndStop) {
  const Bars one = {{0, 1, 5}};
  std::vector<double> out(20);
  const Grid grid{0, 1, 10};
  expect_error(ErrorKind::usage, "layers: found 0", [&] { landscape(one, grid, 0, out); });
  expect_error(ErrorKind::usage, "layers: found 0", [&] { exact_landscape(one, 0); });
  expect_error(ErrorKind::usage, "2 places and 1 values", [] { PiecewiseLinear{{1, 2}, {3}}(1); });
  expect_error(ErrorKind::usage, "expected 30", [&] { landscape(one, grid, 3, out); });
  expect_error(ErrorKind::bad_data, "expected a finite birth", [&] {
    landscape(Bars{{0, -kInfinity, 5}}, grid, 2, out);
  });
  expect_error(ErrorKind::bad_data, "expected finite bars", [&] {
    exact_landscape(Bars{{0, 1, kInfinity}}, 2);
  });
  std::mt19937 random(3);
  const Bars many = random_bars(random, 3000, 0);
  RunContext context;
  std::stop_source source;
  context.stop = source.get_token();
  context.on_progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "landscape");
    source.request_stop();
  };
  expect_error(ErrorKind::cancelled, "stopped", [&] {
    for (int i = 0; i < 100; ++i) exact_landscape(many, many.size(), context);
  });
  source = {};
  RunContext small;
  small.memory.set_limit(1000);
  expect_error(ErrorKind::resource, "memory limit", [&] { landscape(many, grid, 2, out, small); });
}

}  // namespace
}  // namespace ph
