// SPDX-License-Identifier: MIT
// Compares the bottleneck distance between small diagrams with the best of all matchings, and
// between larger diagrams with the result of a slow algorithm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "ph/distances.hpp"
#include "ph/error.hpp"
#include "tests/support/random_bars.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

using test::Bars;
using test::random_bars;

double apart(const Bar& a, const Bar& b) {
  return std::max(std::abs(a.birth - b.birth), std::abs(a.death - b.death));
}

/// The least possible value of the largest cost, over all ways to pair the bars of `a`, from the
/// i-th on, with unused bars of `b` or the diagonal.
double best_of_all(const Bars& a, const Bars& b, std::vector<bool>& used, std::size_t i) {
  if (i == a.size()) {
    double worst = 0;
    for (std::size_t j = 0; j < b.size(); ++j)
      if (!used[j]) worst = std::max(worst, b[j].persistence() / 2);
    return worst;
  }
  double best = std::max(a[i].persistence() / 2, best_of_all(a, b, used, i + 1));
  for (std::size_t j = 0; j < b.size(); ++j) {
    if (used[j]) continue;
    used[j] = true;
    best = std::min(best, std::max(apart(a[i], b[j]), best_of_all(a, b, used, i + 1)));
    used[j] = false;
  }
  return best;
}

double by_all_matchings(const Bars& a, const Bars& b) {
  std::vector<bool> used(b.size());
  return best_of_all(a, b, used, 0);
}

/// The bottleneck distance by a simple method: for each bar, the other diagram gets a copy of the
/// diagonal. All costs are listed, and a matching grows pair by pair.
double by_growing_matchings(const Bars& a, const Bars& b) {
  const std::size_t n = a.size() + b.size();
  std::vector<double> costs(n * n, 0.0), values{0};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double& cost = costs[i * n + j];
      if (i < a.size() && j < b.size()) cost = apart(a[i], b[j]);
      if (i < a.size() && j >= b.size()) cost = a[i].persistence() / 2;
      if (i >= a.size() && j < b.size()) cost = b[j].persistence() / 2;
      values.push_back(cost);
    }
  std::ranges::sort(values);
  const auto is_possible = [&](double value) {
    std::vector<std::size_t> mate(n, n);
    std::vector<bool> seen;
    const std::function<bool(std::size_t)> place = [&](std::size_t i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (seen[j] || costs[i * n + j] > value) continue;
        seen[j] = true;
        if (mate[j] < n && !place(mate[j])) continue;
        mate[j] = i;
        return true;
      }
      return false;
    };
    for (std::size_t i = 0; i < n; ++i) {
      seen.assign(n, false);
      if (!place(i)) return false;
    }
    return true;
  };
  return *std::ranges::partition_point(values, [&](double v) { return !is_possible(v); });
}

TEST(Bottleneck, IsTheBestOfAllMatchings) {
  std::mt19937 random(1);
  for (int round = 0; round < 600; ++round) {
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 4 : 12;
    const Bars a = random_bars(random, random() % 8, steps);
    const Bars b = random_bars(random, random() % 8, steps);
    ASSERT_EQ(bottleneck_distance(a, b), by_all_matchings(a, b)) << round;
  }
}

TEST(Bottleneck, IsThatOfGrowingMatchings) {
  std::mt19937 random(2);
  for (int round = 0; round < 40; ++round) {
    const int steps = round % 2 == 0 ? 0 : 20;
    const Bars a = random_bars(random, 10 + random() % 51, steps);
    Bars b = a;  // in half of the rounds, every bar of `b` is near a bar of `a`
    if (round % 4 < 2)
      b = random_bars(random, 10 + random() % 51, steps);
    else
      for (Bar& bar : b) bar.death += 0.05 * std::uniform_real_distribution<>()(random);
    std::ranges::shuffle(b, random);
    const double expected = by_growing_matchings(a, b);
    ASSERT_EQ(bottleneck_distance(a, b), expected) << round;
    ASSERT_EQ(bottleneck_distance(b, a), expected) << round;
  }
}

// The bars of the two diagrams alternate in a row, with the unmatched bars at its ends. The paths
// between unmatched bars are therefore long.
TEST(Bottleneck, OfBarsInARow) {
  std::mt19937 random(6);
  for (int round = 0; round < 20; ++round) {
    Bars a, b;
    for (int i = 0; i < 300; ++i) {
      a.push_back({1, 0, 1000.0 + i});
      b.push_back({1, 0, i == 150 ? 999.5 : 1000.5 + i});
    }
    std::ranges::shuffle(a, random);
    std::ranges::shuffle(b, random);
    ASSERT_EQ(bottleneck_distance(a, b), 0.5) << round;
    ASSERT_EQ(bottleneck_distance(b, a), 0.5) << round;
  }
}

TEST(Bottleneck, BoundsAreAsNearAsAsked) {
  std::mt19937 random(7);
  int narrower = 0, beyond = 0;
  for (int round = 0; round < 300; ++round) {
    const int steps = round % 3 == 0 ? 9 : 0;
    const Bars a = random_bars(random, 5 + random() % 200, steps);
    const Bars b = random_bars(random, 5 + random() % 200, steps);
    const double distance = bottleneck_distance(a, b);
    const double error = round % 2 == 0 ? 0.5 : 0.01;
    const DistanceBounds near = bottleneck_bounds(a, b, {.relative_error = error});
    ASSERT_LE(near.lower, distance) << round;
    ASSERT_GE(near.value, distance) << round;
    ASSERT_LE(near.value, (1 + error) * near.lower) << round;
    narrower += near.value > near.lower ? 1 : 0;
    const DistanceBounds all = bottleneck_bounds(a, b, {});
    ASSERT_EQ(all.value, distance) << round;
    ASSERT_EQ(all.lower, distance) << round;
    // The bound is just below the distance, far below it, or equal to it.
    for (const double at_most : {std::nextafter(distance, 0.0), distance / 3, distance}) {
      const DistanceBounds most = bottleneck_bounds(a, b, {.at_most = at_most});
      ASSERT_LE(most.lower, distance) << round;
      ASSERT_GE(most.value, distance) << round;
      if (distance > at_most) {
        ASSERT_GT(most.lower, at_most) << round;
        beyond += most.value > most.lower ? 1 : 0;
      } else {
        ASSERT_EQ(most.value, distance) << round;
        ASSERT_EQ(most.lower, distance) << round;
      }
    }
  }
  EXPECT_GT(narrower, 50);  // in these rounds, the two bounds differed
  EXPECT_GT(beyond, 50);    // in these rounds, the computation stopped at the bound
}

TEST(Bottleneck, RefusesLimitsOutOfRange) {
  const Bars one = {{0, 1, 5}};
  for (const double error : {-0.1, kInfinity, std::nan("")})
    EXPECT_THROW(bottleneck_bounds(one, one, {.relative_error = error}), Error) << error;
  EXPECT_THROW(bottleneck_bounds(one, one, {.at_most = std::nan("")}), Error);
  EXPECT_EQ(bottleneck_bounds(one, one, {.at_most = -1}).lower, 0);
}

TEST(Bottleneck, IsAMetric) {
  std::mt19937 random(8);
  for (int round = 0; round < 100; ++round) {
    Bars bars[3];
    for (Bars& b : bars) b = random_bars(random, 40 + random() % 40, round % 2 == 0 ? 30 : 0);
    const auto d = [&](int i, int j) { return bottleneck_distance(bars[i], bars[j]); };
    ASSERT_EQ(d(0, 0), 0) << round;
    ASSERT_EQ(d(0, 1), d(1, 0)) << round;
    ASSERT_LE(d(0, 2), d(0, 1) + d(1, 2) + 1e-15) << round;
  }
}

// With copies of bars, bars on the diagonal, or clusters far from each other, other programs have
// looped forever.
TEST(Bottleneck, OfManyCopies) {
  const Bars million(1'000'000, {1, 0.25, 0.75}), half(500'000, {1, 0.25, 0.75});
  EXPECT_EQ(bottleneck_distance(half, half), 0);
  EXPECT_EQ(bottleneck_distance(million, half), 0.25);
  EXPECT_EQ(bottleneck_distance(half, Bars(500'000, {1, 0.25, 0.875})), 0.125);
  Bars a(3000, {1, 5, 5}), b(3000, {1, 0, 1e-12});
  for (int i = 0; i < 3000; ++i) {
    a.push_back({1, 1e6, 1e6 + 1 + i % 3});
    b.push_back({1, 1e6, 1e6 + 1 + i % 2});
  }
  // None of the 1 000 bars of length 3 has a partner of the same length. A partner of length 2
  // costs 1.
  EXPECT_EQ(bottleneck_distance(a, b), 1);
}

TEST(Bottleneck, OfDiagramsThatAreKnown) {
  const Bars none, one = {{0, 1, 5}}, two = {{0, 1, 5}, {0, 2, 2.5}};
  EXPECT_EQ(bottleneck_distance(none, none), 0);
  EXPECT_EQ(bottleneck_distance(one, none), 2);
  EXPECT_EQ(bottleneck_distance(one, one), 0);
  EXPECT_EQ(bottleneck_distance(one, two), 0.25);
  EXPECT_EQ(bottleneck_distance(Bars{{0, 1, 5}, {0, 1, 5}}, one), 2);  // each copy counts
  // A bar of length 0 does not count.
  EXPECT_EQ(bottleneck_distance(Bars{{0, 3, 3}, {0, 1, 5}}, one), 0);
  EXPECT_EQ(bottleneck_distance(Bars{{0, 0, 10}}, Bars{{0, 1, 8}}), 2);
}

TEST(Bottleneck, BarsWithoutEndAreForEachOther) {
  const Bars a = {{0, 0, kInfinity}, {0, 3, kInfinity}, {0, 0, 1}};
  EXPECT_EQ(bottleneck_distance(a, Bars{{0, 3.5, kInfinity}, {0, 0.25, kInfinity}}), 0.5);
  EXPECT_EQ(bottleneck_distance(a, Bars{{0, 0, kInfinity}}), kInfinity);
  const Bars always = {{0, -kInfinity, 2}, {0, -kInfinity, kInfinity}};
  EXPECT_EQ(bottleneck_distance(always, Bars{{0, -kInfinity, kInfinity}, {0, -kInfinity, 5}}), 3);
  EXPECT_EQ(bottleneck_distance(always, Bars{{0, -kInfinity, 2}, {0, 2, kInfinity}}), kInfinity);
  EXPECT_EQ(bottleneck_distance(Bars{{0, kInfinity, kInfinity}}, {}), 0);
}

/// Checks that a pairing proves the distance: by the definition, the cost of each pair is at most
/// the distance, without a tolerance for rounding.
void expect_certificate(const Bars& a, const Bars& b, const BottleneckMatching& matching,
                        const std::string& where) {
  std::vector<bool> in_a(a.size()), in_b(b.size());
  for (const auto& [i, j] : matching.pairs) {
    ASSERT_LT(i, a.size()) << where;
    ASSERT_LT(j, b.size()) << where;
    ASSERT_FALSE(in_a[i] || in_b[j]) << where << ": in two pairs";
    in_a[i] = in_b[j] = true;
    const auto difference = [](double x, double y) { return x == y ? 0 : std::abs(x - y); };
    ASSERT_LE(difference(a[i].birth, b[j].birth), matching.distance) << where;
    ASSERT_LE(difference(a[i].death, b[j].death), matching.distance) << where;
  }
  for (const auto& [bars, paired] : {std::pair(&a, &in_a), std::pair(&b, &in_b)})
    for (std::size_t i = 0; i < bars->size(); ++i)
      if (!(*paired)[i]) {
        ASSERT_LE((*bars)[i].persistence() / 2, matching.distance) << where;
      }
}

TEST(Bottleneck, ItsMatchingCostsNoMore) {
  std::mt19937 random(5);
  for (int round = 0; round < 3000; ++round) {
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 5 : 15;
    Bars a = random_bars(random, random() % 14, steps),
         b = random_bars(random, random() % 14, steps);
    if (round % 4 == 0) {  // most bars have a close partner
      b = a;
      for (Bar& bar : b) bar.death += 0.3 * std::uniform_real_distribution<>()(random);
      std::ranges::shuffle(b, random);
    }
    for (auto k = random() % 3; k > 0; --k) {
      a.push_back({1, static_cast<double>(random() % 5), kInfinity});
      b.insert(b.begin(), {1, static_cast<double>(random() % 5), kInfinity});
    }
    const BottleneckMatching matching = bottleneck_matching(a, b);
    ASSERT_EQ(matching.distance, bottleneck_distance(a, b)) << round;
    expect_certificate(a, b, matching, std::to_string(round));
    ASSERT_TRUE(std::ranges::is_sorted(matching.pairs)) << round;
  }
}

TEST(Bottleneck, EqualBarsArePairedAndWhatDiffersForEverIsNot) {
  const Bars a = {{0, 0, 1}, {0, 0, kInfinity}, {0, -kInfinity, kInfinity}, {0, 2, 2}};
  const BottleneckMatching same = bottleneck_matching(a, a);
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(same.distance, 0);
  EXPECT_EQ(same.pairs, (Pairs{{0, 0}, {1, 1}, {2, 2}}));  // a bar of length 0 does not count
  const BottleneckMatching other = bottleneck_matching(a, Bars{{0, 0, 1}});
  EXPECT_EQ(other.distance, kInfinity);
  EXPECT_TRUE(other.pairs.empty());
}

TEST(Bottleneck, IsStableAndSymmetricForManyBars) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> noise(-0.01, 0.01);
  const Bars a = random_bars(random, 4000, 0);
  Bars b = a;
  double moved = 0;
  for (Bar& bar : b) {
    const Bar old = bar;
    bar.birth += noise(random);
    bar.death = std::max(bar.birth, bar.death + noise(random));
    moved = std::max(moved, apart(old, bar));
  }
  std::ranges::shuffle(b, random);
  const double distance = bottleneck_distance(a, b);
  EXPECT_GT(distance, 0);
  EXPECT_LE(distance, moved);
  EXPECT_EQ(bottleneck_distance(b, a), distance);
}

TEST(Bottleneck, OfValuesAtTheEndsOfADouble) {
  const double most = std::numeric_limits<double>::max(), least = 5e-324;
  EXPECT_EQ(bottleneck_distance(Bars{{0, -most, most}}, {}), most);
  EXPECT_EQ(bottleneck_distance(Bars{{0, 0, 2 * least}}, {}), least);
  EXPECT_EQ(bottleneck_distance(Bars{{0, 0, most}}, Bars{{0, 0, most / 2}}), most / 2);
}

TEST(Bottleneck, RefusesWhatIsNoBar) {
  for (const Bar& bar : {Bar{0, 2, 1}, Bar{0, std::nan(""), 1}, Bar{0, 0, std::nan("")}}) {
    EXPECT_THROW(bottleneck_distance(Bars{bar}, {}), Error);
    EXPECT_THROW(bottleneck_distance({}, Bars{bar}), Error);
  }
}

TEST(Bottleneck, StopsWhenAsked) {
  std::mt19937 random(4);
  const Bars a = random_bars(random, 3000, 0), b = random_bars(random, 3000, 0);
  test::StoppedContext context;
  EXPECT_THROW(bottleneck_distance(a, b, context), Error);
  test::LimitedContext small(1000);
  EXPECT_THROW(bottleneck_distance(a, b, small), Error);
}

TEST(Bottleneck, StopsInTheMiddle) {
  std::mt19937 random(9);
  const Bars a = random_bars(random, 100'000, 0), b = random_bars(random, 100'000, 0);
  test::StoppableContext context;
  context.on_progress = [&](const Progress& progress) {
    if (progress.stage == "bottleneck distance") context.request_stop();
  };
  EXPECT_THROW(bottleneck_distance(a, b, context), Error);
  EXPECT_EQ(context.memory.used(), 0);
}

}  // namespace
}  // namespace ph
