// SPDX-License-Identifier: MIT
// Sliced Wasserstein distances, distances between many diagrams, barycentres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "ph/distances.hpp"
#include "ph/error.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/random_bars.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

using Spans = std::vector<std::span<const Bar>>;
using test::Bars;
using test::expect_error;
using test::random_bars;

Spans spans_of(const std::vector<Bars>& diagrams) { return {diagrams.begin(), diagrams.end()}; }

// ---- sliced Wasserstein

/// The 1-Wasserstein distance between two sets of numbers: the integral over x of the absolute
/// difference between the two counts of numbers below x.
double between(std::vector<std::pair<double, int>> numbers) {
  std::ranges::sort(numbers);
  double sum = 0;
  int more = 0;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    more += numbers[i].second;
    sum += std::abs(more) * (numbers[i + 1].first - numbers[i].first);
  }
  return sum;
}

double by_definition(const Bars& a, const Bars& b, int directions) {
  double sum = 0;
  for (int k = 0; k < directions; ++k) {
    const double x = std::cos(k * std::numbers::pi / directions),
                 y = std::sin(k * std::numbers::pi / directions);
    std::vector<std::pair<double, int>> numbers;
    for (const int sign : {1, -1})
      for (const Bar& bar : sign > 0 ? a : b) {
        const double middle = (bar.birth + bar.death) / 2;
        numbers.emplace_back(x * bar.birth + y * bar.death, sign);
        numbers.emplace_back((x + y) * middle, -sign);
      }
    sum += between(numbers);
  }
  return sum / directions;
}

TEST(SlicedWasserstein, IsTheMeanOverDirections) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const Bars a = random_bars(random, random() % 40), b = random_bars(random, random() % 40);
    const int directions = 1 + static_cast<int>(random() % 60);
    const double expected = by_definition(a, b, directions);
    const double found = sliced_wasserstein_distance(a, b, directions);
    ASSERT_NEAR(found, expected, 1e-12 * (1 + expected)) << round;
    ASSERT_EQ(sliced_wasserstein_distance(b, a, directions), found) << round;
    ASSERT_EQ(sliced_wasserstein_distance(a, a, directions), 0) << round;
    ASSERT_LE(found, 2 * std::numbers::sqrt2 * wasserstein_distance(a, b).value * (1 + 1e-12));
  }
}

// The mean of |cos| is 2/π. The distance from a bar to the diagonal is √2 times half the length of
// the bar.
TEST(SlicedWasserstein, OfOneBar) {
  const double found = sliced_wasserstein_distance(Bars{{0, 1, 5}}, {}, 2000);
  EXPECT_NEAR(found, 2 * std::numbers::sqrt2 * 2 / std::numbers::pi, 1e-5);
  EXPECT_EQ(sliced_wasserstein_distance({}, {}), 0);
  EXPECT_EQ(sliced_wasserstein_distance(Bars{{0, 2, 2}}, {}), 0);
  // With one direction, only births are compared. The directions divide a half circle, whose second
  // end is left out because it is opposite to the first.
  EXPECT_DOUBLE_EQ(sliced_wasserstein_distance(Bars{{0, 1, 5}}, {}, 1), 2);
}

TEST(SlicedWasserstein, BarsWithoutEndAreForEachOther) {
  const Bars a = {{0, 0, kInfinity}, {0, 3, kInfinity}};
  EXPECT_EQ(sliced_wasserstein_distance(a, Bars{{0, 3.5, kInfinity}, {0, 0.25, kInfinity}}), 0.75);
  EXPECT_EQ(sliced_wasserstein_distance(a, {}), kInfinity);
}

TEST(SlicedWasserstein, UnitsAndThreadsDoNotMatter) {
  std::mt19937 random(2);
  const Bars a = random_bars(random, 500), b = random_bars(random, 400);
  const double found = sliced_wasserstein_distance(a, b);
  for (const int exponent : {900, -900, 1022}) {
    Bars bars[2] = {a, b};
    for (Bars& side : bars)
      for (Bar& bar : side)
        bar = {0, std::ldexp(bar.birth, exponent), std::ldexp(bar.death, exponent)};
    EXPECT_EQ(sliced_wasserstein_distance(bars[0], bars[1]), std::ldexp(found, exponent));
  }
  for (const int threads : {1, 2, 5}) {
    test::ThreadsContext context(threads);
    EXPECT_EQ(sliced_wasserstein_distance(a, b, 50, context), found) << threads;
    EXPECT_EQ(context.memory.used(), 0U);
  }
  expect_error(ErrorKind::usage, "found 0 directions",
               [&] { sliced_wasserstein_distance(a, b, 0); });
  expect_error(ErrorKind::bad_data, "sliced_wasserstein_distance: found a bar", [&] {
    sliced_wasserstein_distance(a, Bars{{0, 2, 1}});
  });
  test::LimitedContext small(1000);
  EXPECT_THROW(sliced_wasserstein_distance(a, b, 50, small), Error);
}

// ---- many diagrams

TEST(DiagramDistances, AreThoseOfAllPairs) {
  std::mt19937 random(3);
  std::vector<Bars> diagrams;
  for (int i = 0; i < 12; ++i) diagrams.push_back(random_bars(random, 5 + random() % 100));
  for (const int threads : {1, 2, 4}) {
    test::ThreadsContext context(threads);
    context.memory.set_limit(100'000'000);
    const DistanceMatrix found = diagram_distances(
        spans_of(diagrams),
        [](std::span<const Bar> a, std::span<const Bar> b, const RunContext& task) {
          EXPECT_EQ(task.threads, 1);
          EXPECT_LE(task.memory.limit(), 100'000'000U);
          return wasserstein_distance(a, b, {}, task).value;
        },
        context);
    ASSERT_EQ(found.size(), 12);
    for (Index i = 0; i < 12; ++i)
      for (Index j = 0; j < i; ++j) {
        const Bars &a = diagrams[static_cast<std::size_t>(i)],
                   &b = diagrams[static_cast<std::size_t>(j)];
        ASSERT_EQ(found(i, j), wasserstein_distance(a, b).value) << threads;
      }
  }
  const auto none = [](std::span<const Bar>, std::span<const Bar>, const RunContext&) {
    return 0.0;
  };
  EXPECT_EQ(diagram_distances({}, none).size(), 0);
}

TEST(DiagramDistances, OfSomeFromOthers) {
  std::mt19937 random(8);
  std::vector<Bars> some, others;
  for (int i = 0; i < 3; ++i) some.push_back(random_bars(random, 5 + random() % 100));
  for (int i = 0; i < 5; ++i) others.push_back(random_bars(random, 5 + random() % 100));
  // The function is not symmetric, so its values show in which order it gets its arguments.
  const auto difference = [](std::span<const Bar> a, std::span<const Bar> b, const RunContext&) {
    return static_cast<double>(1000 + a.size()) - static_cast<double>(b.size());
  };
  for (const int threads : {1, 3}) {
    test::ThreadsContext context(threads);
    std::vector<double> expected;
    for (const Bars& a : some)
      for (const Bars& b : others) expected.push_back(difference(a, b, context));
    EXPECT_EQ(diagram_distances(spans_of(some), spans_of(others), difference, context), expected);
  }
  EXPECT_TRUE(diagram_distances(spans_of(some), {}, difference).empty());
}

TEST(DiagramDistances, EndWithTheirErrors) {
  std::mt19937 random(4);
  std::vector<Bars> diagrams(5, random_bars(random, 10));
  diagrams[3].push_back({0, 2, 1});
  const auto bottleneck = [](std::span<const Bar> a, std::span<const Bar> b, const RunContext& c) {
    return bottleneck_distance(a, b, c);
  };
  expect_error(ErrorKind::bad_data, "found a bar [2, 1)",
               [&] { diagram_distances(spans_of(diagrams), bottleneck); });
  diagrams[3].pop_back();
  test::StoppedContext context;
  EXPECT_THROW(diagram_distances(spans_of(diagrams), bottleneck, context), Error);
  test::LimitedContext small(100);
  EXPECT_THROW(diagram_distances(spans_of(diagrams), bottleneck, small), Error);
}

// ---- barycentres

double root_mean_square(const Bars& bars, const std::vector<Bars>& diagrams) {
  double sum = 0;
  for (const Bars& diagram : diagrams) {
    const double d = wasserstein_distance(bars, diagram, {.order = 2, .ground = 2}).value;
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(diagrams.size()));
}

TEST(BarycentreOfDiagrams, ThatAreKnown) {
  const std::vector<Bars> one = {{{0, 1, 5}, {0, 3, 3}}};
  EXPECT_EQ(barycentre(spans_of(one)).bars, (Bars{{0, 1, 5}}));
  const std::vector<Bars> three(3, {{0, 1, 5}, {0, 0, 2}});
  const Barycentre same = barycentre(spans_of(three));
  EXPECT_EQ(same.bars, (Bars{{0, 0, 2}, {0, 1, 5}}));
  EXPECT_EQ(same.root_mean_square, 0);
  EXPECT_TRUE(same.converged);
  const std::vector<Bars> two = {{{0, 1, 5}, {0, 10, kInfinity}}, {{0, 2, 8}, {0, 14, kInfinity}}};
  const Barycentre middle = barycentre(spans_of(two));
  EXPECT_EQ(middle.bars, (Bars{{0, 1.5, 6.5}, {0, 12, kInfinity}}));
  EXPECT_DOUBLE_EQ(middle.root_mean_square, std::sqrt(0.25 + 2.25 + 4));
  EXPECT_EQ(middle.rounds, 1);
  // One diagram has a bar, and the other three diagrams are empty. The bar of the barycentre has a
  // quarter of the length.
  const std::vector<Bars> alone = {{}, {{0, 0, 8}}, {}, {}};
  const Barycentre quarter = barycentre(spans_of(alone));
  EXPECT_EQ(quarter.bars, (Bars{{0, 3, 5}}));
  EXPECT_DOUBLE_EQ(quarter.root_mean_square, std::sqrt((18 + 3 * 2) / 4.0));
  EXPECT_TRUE(barycentre(Spans{{}, {}}).bars.empty());
}

TEST(BarycentreOfDiagrams, IsALocalMinimum) {
  std::mt19937 random(5);
  std::normal_distribution<> noise(0, 0.02);
  for (int round = 0; round < 8; ++round) {
    const Bars common = random_bars(random, 12);
    std::vector<Bars> diagrams;
    for (int i = 0; i < 5; ++i) {
      Bars bars = random_bars(random, 3);
      for (const Bar& bar : common) {
        const double birth = bar.birth + noise(random);
        bars.push_back({0, birth, std::max(birth, bar.death + noise(random))});
      }
      diagrams.push_back(bars);
    }
    const Barycentre medoid = barycentre(spans_of(diagrams), {.most_rounds = 0});
    EXPECT_EQ(medoid.rounds, 0);
    const Barycentre found = barycentre(spans_of(diagrams), {.least_gain = 0});
    EXPECT_TRUE(found.converged);
    ASSERT_LT(found.root_mean_square, medoid.root_mean_square) << round;
    double least = kInfinity;
    for (const Bars& diagram : diagrams)
      least = std::min(least, root_mean_square(diagram, diagrams));
    ASSERT_LE(medoid.root_mean_square, 1.01 * least) << round;
    ASSERT_NEAR(root_mean_square(found.bars, diagrams), found.root_mean_square, 1e-10) << round;
    // Checks that no small change of a bar improves the barycentre.
    for (Bar& bar : Bars(found.bars)) {
      Bars moved = found.bars;
      auto& other = *std::ranges::find(moved, bar);
      const double step = 1e-4 * bar.persistence();
      other.birth += random() % 2 == 0 ? step : -step;
      other.death += random() % 2 == 0 ? step : -step;
      ASSERT_GT(root_mean_square(moved, diagrams), found.root_mean_square * (1 - 1e-12)) << round;
    }
  }
}

TEST(BarycentreOfDiagrams, ThreadsAndUnitsDoNotMatter) {
  std::mt19937 random(6);
  std::vector<Bars> diagrams, large;
  for (int i = 0; i < 7; ++i) {
    diagrams.push_back(random_bars(random, 60));
    large.push_back(diagrams.back());
    for (Bar& bar : large.back()) bar = {0, std::ldexp(bar.birth, 700), std::ldexp(bar.death, 700)};
  }
  const Barycentre expected = barycentre(spans_of(diagrams));
  EXPECT_GT(expected.rounds, 0);
  for (const int threads : {1, 2, 4}) {
    test::ThreadsContext context(threads);
    const Barycentre found = barycentre(spans_of(diagrams), {}, context);
    EXPECT_EQ(found.bars, expected.bars) << threads;
    EXPECT_EQ(found.root_mean_square, expected.root_mean_square) << threads;
  }
  const Barycentre found = barycentre(spans_of(large));
  EXPECT_EQ(found.root_mean_square, std::ldexp(expected.root_mean_square, 700));
  EXPECT_EQ(found.bars.size(), expected.bars.size());
}

TEST(BarycentreOfDiagrams, RefusesWhatMakesNoSense) {
  const Bars one = {{0, 1, 5}}, infinite = {{0, 1, kInfinity}}, wrong = {{0, 2, 1}};
  expect_error(ErrorKind::usage, "no diagram", [&] { barycentre({}); });
  expect_error(ErrorKind::usage, "most_rounds",
               [&] { barycentre(Spans{one}, {.most_rounds = -1}); });
  expect_error(ErrorKind::usage, "least_gain",
               [&] { barycentre(Spans{one}, {.least_gain = std::nan("")}); });
  expect_error(ErrorKind::bad_data, "diagram 1", [&] { barycentre(Spans{one, infinite}); });
  expect_error(ErrorKind::bad_data, "found a bar", [&] { barycentre(Spans{one, wrong}); });
}

}  // namespace
}  // namespace ph
