// SPDX-License-Identifier: MIT
#include "libph/src/core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace ph {
namespace {

TEST(Randoms, BelowIsUniform) {
  Random random(1);
  for (const std::uint64_t count : {1, 2, 7, 10}) {
    std::map<std::uint64_t, int> seen;
    for (int i = 0; i < 20000; ++i) ++seen[random.below(count)];
    ASSERT_EQ(seen.size(), count);
    const double expected = 20000.0 / static_cast<double>(count);
    for (const auto& [number, times] : seen) EXPECT_NEAR(times, expected, 5 * std::sqrt(expected));
  }
}

TEST(Randoms, NormalHasItsMoments) {
  Random random(2);
  constexpr int n = 200000;
  double mean = 0, square = 0, fourth = 0;
  int below_one = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    mean += x / n;
    square += x * x / n;
    fourth += x * x * x * x / n;
    below_one += x < 1;
  }
  EXPECT_NEAR(mean, 0, 0.01);
  EXPECT_NEAR(square, 1, 0.02);
  EXPECT_NEAR(fourth, 3, 0.15);
  EXPECT_NEAR(static_cast<double>(below_one) / n, 0.841345, 0.004);
}

TEST(Randoms, EachSubsetIsDrawnAsOften) {
  Random random(3);
  std::map<std::set<int>, int> seen;
  for (int i = 0; i < 10000; ++i) {
    std::vector<int> numbers{0, 1, 2, 3, 4};
    draw(numbers, 2, random);
    ASSERT_EQ(std::set<int>(numbers.begin(), numbers.end()).size(), 5U);
    ++seen[{numbers[0], numbers[1]}];
  }
  ASSERT_EQ(seen.size(), 10U);
  for (const auto& [subset, times] : seen) EXPECT_NEAR(times, 1000, 160);
}

TEST(Randoms, TasksHaveSequencesOfTheirOwn) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (std::uint64_t task = 0; task < 30; ++task) seen.insert(Random(seed, task).bits());
  EXPECT_EQ(seen.size(), 900U);
  EXPECT_EQ(Random(4, 5).bits(), Random(4, 5).bits());
}

}  // namespace
}  // namespace ph
