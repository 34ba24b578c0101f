// SPDX-License-Identifier: MIT
// Compares the Wasserstein distance between small diagrams with the best of all matchings, and
// between larger diagrams with the result of the Hungarian method.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "ph/distances.hpp"
#include "ph/error.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/random_bars.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

using test::Bars;
using test::random_bars;

double norm(double x, double y, double q) {
  if (q == kInfinity) return std::max(std::abs(x), std::abs(y));
  return std::pow(std::pow(std::abs(x), q) + std::pow(std::abs(y), q), 1 / q);
}

/// The cost of a pair, and the cost of an unmatched bar, which is its distance to the nearest point
/// of the diagonal.
double pair_cost(const Bar& a, const Bar& b, double p, double q) {
  return std::pow(norm(a.birth - b.birth, a.death - b.death, q), p);
}
double alone_cost(const Bar& a, double p, double q) {
  const double middle = (a.birth + a.death) / 2;
  return std::pow(norm(a.birth - middle, a.death - middle, q), p);
}

double best_of_all(const Bars& a, const Bars& b, double p, double q, std::vector<bool>& used,
                   std::size_t i) {
  if (i == a.size()) {
    double sum = 0;
    for (std::size_t j = 0; j < b.size(); ++j)
      if (!used[j]) sum += alone_cost(b[j], p, q);
    return sum;
  }
  double best = alone_cost(a[i], p, q) + best_of_all(a, b, p, q, used, i + 1);
  for (std::size_t j = 0; j < b.size(); ++j) {
    if (used[j]) continue;
    used[j] = true;
    best = std::min(best, pair_cost(a[i], b[j], p, q) + best_of_all(a, b, p, q, used, i + 1));
    used[j] = false;
  }
  return best;
}

/// The Hungarian method on the full square matrix of costs, in which each bar has its own copy of
/// the diagonal.
double by_hungarian_method(const Bars& a, const Bars& b, double p, double q) {
  const std::size_t n = a.size() + b.size();
  const auto cost = [&](std::size_t i, std::size_t j) {
    if (i < a.size() && j < b.size()) return pair_cost(a[i], b[j], p, q);
    if (i < a.size()) return alone_cost(a[i], p, q);
    return j < b.size() ? alone_cost(b[j], p, q) : 0.0;
  };
  std::vector<double> u(n + 1), v(n + 1);
  std::vector<std::size_t> row_of(n + 1, n), way(n + 1, n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> least(n + 1, kInfinity);
    std::vector<bool> used(n + 1);
    row_of[n] = i;
    std::size_t column = n;
    do {
      used[column] = true;
      const std::size_t row = row_of[column];
      double delta = kInfinity;
      std::size_t next = n;
      for (std::size_t j = 0; j < n; ++j) {
        if (used[j]) continue;
        const double slack = cost(row, j) - u[row] - v[j];
        if (slack < least[j]) {
          least[j] = slack;
          way[j] = column;
        }
        if (least[j] < delta) {
          delta = least[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (used[j]) {
          u[row_of[j]] += delta;
          v[j] -= delta;
        } else {
          least[j] -= delta;
        }
      }
      column = next;
    } while (row_of[column] != n);
    while (column != n) {
      row_of[column] = row_of[way[column]];
      column = way[column];
    }
  }
  double sum = 0;
  for (std::size_t j = 0; j < n; ++j) sum += cost(row_of[j], j);
  return sum;
}

/// Checks that bounds enclose a known distance, up to rounding.
/// @param alone the cost of pairing all bars with the diagonal. The rounding errors of prices are
/// proportional to this cost.
void expect_distance(const DistanceBounds& found, double expected, const std::string& where,
                     double p = 1, double alone = 0) {
  ASSERT_NEAR(found.value, expected, 1e-11 * expected) << where;
  ASSERT_LE(found.lower, found.value) << where;
  ASSERT_GE(std::pow(found.lower, p), (1 - 1e-11) * std::pow(expected, p) - 2e-15 * alone) << where;
}

constexpr double kOrders[] = {1, 2, 1.5, 3};
constexpr double kGrounds[] = {kInfinity, 2, 1, 3};

TEST(Wasserstein, IsTheBestOfAllMatchings) {
  std::mt19937 random(1);
  for (int round = 0; round < 640; ++round) {
    const double p = kOrders[round % 4], q = kGrounds[round / 4 % 4];
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 4 : 12;
    const std::size_t most = round < 600 ? 6 : 7;
    const Bars a = random_bars(random, random() % (most + 1), steps);
    const Bars b = random_bars(random, random() % (most + 1), steps);
    std::vector<bool> used(b.size());
    const double expected = std::pow(best_of_all(a, b, p, q, used, 0), 1 / p);
    expect_distance(wasserstein_distance(a, b, {.order = p, .ground = q}), expected,
                    std::to_string(round));
  }
}

/// Checks that each bar is in exactly one pair, and that the pairs have the stated cost.
void expect_matching(const Bars& a, const Bars& b, double p, double q,
                     const WassersteinMatching& found, const std::string& where) {
  std::vector<int> in_a(a.size()), in_b(b.size());
  double sum = 0;
  for (const auto& [i, j] : found.pairs) {
    ASSERT_TRUE(i >= 0 || j >= 0) << where;
    if (i >= 0) ++in_a.at(static_cast<std::size_t>(i));
    if (j >= 0) ++in_b.at(static_cast<std::size_t>(j));
    if (i < 0)
      sum += alone_cost(b[static_cast<std::size_t>(j)], p, q);
    else if (j < 0)
      sum += alone_cost(a[static_cast<std::size_t>(i)], p, q);
    else
      sum += pair_cost(a[static_cast<std::size_t>(i)], b[static_cast<std::size_t>(j)], p, q);
  }
  EXPECT_EQ(std::ranges::count(in_a, 1), std::ssize(a)) << where;
  EXPECT_EQ(std::ranges::count(in_b, 1), std::ssize(b)) << where;
  EXPECT_NEAR(found.distance.value, std::pow(sum, 1 / p), 1e-11 * found.distance.value) << where;
}

TEST(Wasserstein, IsThatOfTheHungarianMethod) {
  std::mt19937 random(2);
  for (int round = 0; round < 48; ++round) {
    const double p = kOrders[round % 4], q = kGrounds[round / 4 % 4];
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 20 : 255;
    const std::size_t most = round < 3 ? 300 : 60;
    const Bars a = random_bars(random, most / 2 + random() % (most / 2), steps);
    Bars b = random_bars(random, most / 2 + random() % (most / 2), steps);
    if (round % 5 == 0) {  // `b` is similar to `a`
      b = a;
      for (Bar& bar : b) bar.death += 0.05 * std::uniform_real_distribution<>()(random);
      std::ranges::shuffle(b, random);
    }
    const std::string where = std::to_string(round);
    const WassersteinMatching found = wasserstein_matching(a, b, {.order = p, .ground = q});
    double alone = 0;
    for (const std::span<const Bar> bars : {std::span(a), std::span<const Bar>(b)})
      for (const Bar& bar : bars) alone += alone_cost(bar, p, q);
    expect_distance(found.distance, std::pow(by_hungarian_method(a, b, p, q), 1 / p), where, p,
                    alone);
    expect_matching(a, b, p, q, found, where);
    const DistanceBounds back = wasserstein_distance(b, a, {.order = p, .ground = q});
    ASSERT_NEAR(back.value, found.distance.value, 1e-11 * back.value) << where;
  }
}

TEST(Wasserstein, BoundsAreAsNearAsAsked) {
  std::mt19937 random(3);
  int narrower = 0, beyond = 0;
  for (int round = 0; round < 60; ++round) {
    const double p = kOrders[round % 4];
    const int steps = round % 3 == 0 ? 9 : 0;
    const Bars a = random_bars(random, 20 + random() % 200, steps);
    const Bars b = random_bars(random, 20 + random() % 200, steps);
    const double distance = wasserstein_distance(a, b, {.order = p}).value;
    const double least = distance * (1 - 1e-12), most = distance * (1 + 1e-12);
    const double error = round % 2 == 0 ? 0.5 : 0.01;
    const DistanceBounds near =
        wasserstein_distance(a, b, {.order = p, .limits = {.relative_error = error}});
    ASSERT_LE(near.lower, most) << round;
    ASSERT_GE(near.value, least) << round;
    ASSERT_LE(near.value, (1 + error) * near.lower) << round;
    narrower += near.value > near.lower * (1 + 1e-9) ? 1 : 0;
    for (const double at_most : {0.9 * distance, distance / 3, 1.1 * distance}) {
      const DistanceBounds found =
          wasserstein_distance(a, b, {.order = p, .limits = {.at_most = at_most}});
      ASSERT_LE(found.lower, most) << round;
      ASSERT_GE(found.value, least) << round;
      if (distance > at_most) {
        ASSERT_GT(found.lower, at_most) << round;
        beyond += found.value > found.lower * (1 + 1e-9) ? 1 : 0;
      } else {
        ASSERT_LE(found.value, most) << round;
      }
    }
  }
  EXPECT_GT(narrower, 30);  // in these rounds, the two bounds differed
  EXPECT_GT(beyond, 30);    // in these rounds, the computation stopped at the bound
}

TEST(Wasserstein, OfDiagramsThatAreKnown) {
  const Bars none, one = {{0, 1, 5}}, two = {{0, 1, 5}, {0, 2, 3}};
  EXPECT_EQ(wasserstein_distance(none, none).value, 0);
  EXPECT_EQ(wasserstein_distance(one, none).value, 2);
  EXPECT_EQ(wasserstein_distance(one, one).value, 0);
  EXPECT_EQ(wasserstein_distance(two, none).value, 2.5);
  EXPECT_EQ(wasserstein_distance(two, none, {.order = 2}).value, std::sqrt(4.25));
  EXPECT_DOUBLE_EQ(wasserstein_distance(one, none, {.ground = 2}).value, 4 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(wasserstein_distance(one, none, {.ground = 1}).value, 4);
  // A bar of length 0 does not count.
  EXPECT_EQ(wasserstein_distance(Bars{{0, 3, 3}, {0, 1, 5}}, one).value, 0);
  EXPECT_EQ(wasserstein_distance(Bars{{0, 0, 10}}, Bars{{0, 1, 8}}).value, 2);
  EXPECT_NEAR(wasserstein_distance(Bars{{0, 0, 10}}, Bars{{0, 1, 8}}, {.ground = 2}).value,
              std::sqrt(5.0), 1e-12);
}

TEST(Wasserstein, BarsWithoutEndAreForEachOther) {
  const Bars a = {{0, 0, kInfinity}, {0, 3, kInfinity}, {0, 0, 1}};
  const Bars b = {{0, 3.5, kInfinity}, {0, 0.25, kInfinity}};
  EXPECT_EQ(wasserstein_distance(a, b).value, 1.25);
  EXPECT_EQ(wasserstein_distance(a, b, {.order = 2}).value, std::sqrt(0.5625));
  // Equal bars in both diagrams do not reduce the precision of the result for the other bars.
  const Bars equal = {{0, 0, 5}, {0, 0, kInfinity}, {0, 100, kInfinity}, {0, 200, kInfinity}};
  const Bars moved = {{0, 0, 5}, {0, 19, kInfinity}, {0, 118, kInfinity}, {0, 205, kInfinity}};
  EXPECT_EQ(wasserstein_distance(equal, moved).value, 42);
  EXPECT_EQ(wasserstein_distance(a, Bars{{0, 0, kInfinity}}).value, kInfinity);
  EXPECT_EQ(wasserstein_distance(a, Bars{{0, 0, kInfinity}}).lower, kInfinity);
  const Bars always = {{0, -kInfinity, 2}, {0, -kInfinity, kInfinity}};
  EXPECT_EQ(
      wasserstein_distance(always, Bars{{0, -kInfinity, kInfinity}, {0, -kInfinity, 5}}).value, 3);
  using Pairs = std::vector<std::pair<std::int64_t, std::int64_t>>;
  EXPECT_EQ(wasserstein_matching(a, b).pairs, (Pairs{{0, 1}, {1, 0}, {2, -1}}));
  EXPECT_EQ(wasserstein_matching(b, a).pairs, (Pairs{{0, 1}, {1, 0}, {-1, 2}}));
  EXPECT_TRUE(wasserstein_matching(a, {}).pairs.empty());
  EXPECT_EQ(wasserstein_matching(Bars{{0, 2, 2}}, {}).pairs, (Pairs{{0, -1}}));
}

TEST(Wasserstein, IsAMetricAboveTheBottleneckDistance) {
  std::mt19937 random(4);
  for (int round = 0; round < 40; ++round) {
    const double p = kOrders[round % 4];
    Bars bars[3];
    for (Bars& b : bars) b = random_bars(random, 40 + random() % 40, round % 2 == 0 ? 30 : 0);
    const auto d = [&](int i, int j) {
      return wasserstein_distance(bars[i], bars[j], {.order = p}).value;
    };
    Bars shuffled = bars[0];
    std::ranges::shuffle(shuffled, random);
    ASSERT_EQ(wasserstein_distance(bars[0], shuffled, {.order = p}).value, 0) << round;
    ASSERT_LE(d(0, 2), (d(0, 1) + d(1, 2)) * (1 + 1e-12)) << round;
    ASSERT_GE(d(0, 1) * (1 + 1e-12), bottleneck_distance(bars[0], bars[1])) << round;
  }
}

TEST(Wasserstein, IsStable) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> noise(-0.01, 0.01);
  const Bars a = random_bars(random, 3000, 0);
  Bars b = a;
  for (Bar& bar : b) {
    bar.birth += noise(random);
    bar.death = std::max(bar.birth, bar.death + noise(random));
  }
  std::ranges::shuffle(b, random);
  for (const double p : {1.0, 2.0}) {
    const double distance = wasserstein_distance(a, b, {.order = p}).value;
    EXPECT_GT(distance, 0);
    EXPECT_LE(distance, 0.02 * std::pow(3000, 1 / p));
  }
}

// With copies of bars, bars on the diagonal, or lengths of many magnitudes, other programs have
// looped forever or returned wrong distances.
TEST(Wasserstein, OfManyCopies) {
  const Bars million(1'000'000, {1, 0.25, 0.75}), half(500'000, {1, 0.25, 0.75});
  for (const double p : {1.0, 2.0}) {
    expect_distance(wasserstein_distance(million, half, {.order = p}),
                    std::pow(500'000 * std::pow(0.25, p), 1 / p), "half");
    const Bars few(20'000, {1, 0.25, 0.75}), moved(20'000, {1, 0.25, 0.875});
    expect_distance(wasserstein_distance(few, moved, {.order = p}), 0.125 * std::pow(20'000, 1 / p),
                    "moved");
  }
}

TEST(Wasserstein, OfGridValues) {
  std::mt19937 random(6);
  for (int round = 0; round < 6; ++round) {
    const double p = round % 2 + 1;
    Bars bars[2];
    for (Bars& side : bars)
      for (int i = 0; i < 3000; ++i) {
        const double birth = static_cast<double>(random() % 16);
        side.push_back(
            // Some bars are on the diagonal.
            {1, birth, birth + static_cast<double>(random() % 4)});
      }
    const WassersteinMatching found = wasserstein_matching(bars[0], bars[1], {.order = p});
    EXPECT_LE(found.distance.value, found.distance.lower * (1 + 1e-11)) << round;
    expect_matching(bars[0], bars[1], p, kInfinity, found, std::to_string(round));
  }
}

TEST(Wasserstein, OfLengthsOfManyMagnitudes) {
  const Bars a = {{0, 0, 1e9}, {0, 1, 1 + 1e-9}, {0, 0, 1e-9}};
  const Bars b = {{0, 0, 1e9}, {0, 1, 1 + 1e-9}};
  const DistanceBounds found = wasserstein_distance(a, b);
  EXPECT_GE(found.value * (1 + 1e-12), 5e-10);
  EXPECT_LE(found.value, 5e-10 * (1 + 1e-6));  // 1 + 1e-9 is not exact as a double
  EXPECT_LE(found.lower, 5e-10 * (1 + 1e-12));
}

TEST(Wasserstein, UnitsOfLengthDoNotMatter) {
  std::mt19937 random(7);
  for (const double p : {1.0, 2.0, 3.0}) {
    const Bars a = random_bars(random, 60, 0), b = random_bars(random, 60, 0);
    const DistanceBounds found = wasserstein_distance(a, b, {.order = p});
    for (const int exponent : {500, -500, 1000, -900}) {
      Bars bars[2] = {a, b};
      for (Bars& side : bars)
        for (Bar& bar : side) {
          bar.birth = std::ldexp(bar.birth, exponent);
          bar.death = std::ldexp(bar.death, exponent);
        }
      const DistanceBounds other = wasserstein_distance(bars[0], bars[1], {.order = p});
      EXPECT_EQ(other.value, std::ldexp(found.value, exponent)) << exponent;
      EXPECT_EQ(other.lower, std::ldexp(found.lower, exponent)) << exponent;
    }
  }
  const double most = std::numeric_limits<double>::max(), least = 5e-324;
  EXPECT_EQ(wasserstein_distance(Bars{{0, -most, most}}, {}).value, most);
  EXPECT_EQ(wasserstein_distance(Bars{{0, 0, 2 * least}}, {}, {.order = 2}).value, least);
  EXPECT_EQ(wasserstein_distance(Bars{{0, 0, most}}, Bars{{0, 0, most / 2}}).value, most / 2);
  EXPECT_DOUBLE_EQ(wasserstein_distance(Bars{{0, 0, 3}}, {}, {.order = 5000}).value, 1.5);
}

TEST(Wasserstein, RefusesWhatMakesNoSense) {
  const Bars one = {{0, 1, 5}};
  const auto of = [&](WassersteinOptions options) {
    return [&one, options] { wasserstein_distance(one, one, options); };
  };
  using test::expect_error;
  const double nan = std::nan("");
  expect_error(ErrorKind::usage, "order: found 0.5", of({.order = 0.5}));
  expect_error(ErrorKind::usage, "order: found nan", of({.order = nan}));
  expect_error(ErrorKind::usage, "bottleneck_distance", of({.order = kInfinity}));
  expect_error(ErrorKind::usage, "ground: found 0.5", of({.ground = 0.5}));
  expect_error(ErrorKind::usage, "ground: found nan", of({.ground = nan}));
  expect_error(ErrorKind::usage, "relative_error", of({.limits = {.relative_error = -1}}));
  expect_error(ErrorKind::usage, "at_most", of({.limits = {.at_most = nan}}));
  for (const Bar& bar : {Bar{0, 2, 1}, Bar{0, nan, 1}, Bar{0, 0, nan}}) {
    expect_error(ErrorKind::bad_data, "wasserstein_distance: found a bar",
                 [&] { wasserstein_distance(Bars{bar}, {}); });
    expect_error(ErrorKind::bad_data, "wasserstein_matching: found a bar",
                 [&] { wasserstein_matching({}, Bars{bar}); });
  }
}

TEST(Wasserstein, StopsWhenAsked) {
  std::mt19937 random(8);
  const Bars a = random_bars(random, 50'000, 0), b = random_bars(random, 50'000, 0);
  test::StoppableContext context;
  context.on_progress = [&](const Progress& progress) {
    if (progress.stage == "Wasserstein distance") context.request_stop();
  };
  EXPECT_THROW(wasserstein_distance(a, b, {}, context), Error);
  EXPECT_EQ(context.memory.used(), 0U);
  test::LimitedContext small(1000);
  EXPECT_THROW(wasserstein_distance(a, b, {}, small), Error);
}

}  // namespace
}  // namespace ph
