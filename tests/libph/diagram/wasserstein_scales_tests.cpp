// SPDX-License-Identifier: MIT
// Wasserstein distances that are far smaller than the lengths of the bars: compares them with the
// best of all matchings, computed in long doubles, which are precise enough for the powers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ph/distances.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

using Bars = std::vector<Bar>;
using Real = long double;

struct Costs {
  double order, ground;

  Real norm(Real x, Real y) const {
    x = std::abs(x);
    y = std::abs(y);
    if (std::isinf(ground)) return std::max(x, y);
    if (x == 0 && y == 0) return 0;
    const Real larger = std::max(x, y);
    return larger *
           std::pow(std::pow(x / larger, Real{ground}) + std::pow(y / larger, Real{ground}),
                    1 / Real{ground});
  }
  Real power(Real length) const { return std::pow(length, Real{order}); }
  Real pair(const Bar& a, const Bar& b) const {
    return power(norm(Real{a.birth} - b.birth, Real{a.death} - b.death));
  }
  Real alone(const Bar& a) const {
    const Real half = (Real{a.death} - a.birth) / 2;
    return power(norm(half, half));
  }
  Real least(const Bars& a, const Bars& b, std::vector<bool>& used, std::size_t i) const {
    Real best = 0;
    if (i == a.size()) {
      for (std::size_t j = 0; j < b.size(); ++j)
        if (!used[j]) best += alone(b[j]);
      return best;
    }
    best = alone(a[i]) + least(a, b, used, i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (used[j]) continue;
      used[j] = true;
      best = std::min(best, pair(a[i], b[j]) + least(a, b, used, i + 1));
      used[j] = false;
    }
    return best;
  }
};

// Tests the precision of prices. If every price had only the absolute precision of the highest
// price, matchings of orders above about 6 would be random.
TEST(WassersteinScales, SmallDifferencesOfLongBars) {
  for_each_seed(3000, [](Generator& random, bool has_ties, std::int64_t) {
    static constexpr double orders[]{1, 2, 3, 4, 8, 16, 30};
    static constexpr double grounds[]{1, 2, 3, kInfinity};
    const Costs costs{orders[random.integer(0, 6)], grounds[random.integer(0, 3)]};
    const double apart = std::ldexp(1, -random.integer(2, 40));
    const double scale = std::ldexp(1, random.integer(-300, 300));
    const auto shift = [&] {
      return apart * (has_ties ? 0.5 * random.integer(-2, 2) : 2 * random.real() - 1);
    };
    Bars a, b;
    const int count = random.integer(1, 4);
    for (int i = 0; i < count; ++i) {
      const Bar bar{1, double(random.integer(0, 1)), 2.0 + random.integer(0, 1)};
      for (Bars* bars : {&a, &b})
        bars->push_back({1, scale * (bar.birth + shift()), scale * (bar.death + shift())});
    }
    // Adds short bars. An unmatched short bar costs about as much as a pair.
    for (Bars* bars : {&a, &b})
      for (int i = random.integer(0, 1); i > 0; --i) {
        const double birth = 1 + shift();
        bars->push_back({1, scale * birth, scale * (birth + 4 * apart * random.real())});
      }
    std::ranges::reverse(b);
    // The oracle gets the bars divided by `scale`, so that their lengths are about 1 and long
    // doubles have enough digits.
    std::vector<bool> used(b.size());
    Bars a_in_unit = a, b_in_unit = b;
    for (Bars* bars : {&a_in_unit, &b_in_unit})
      for (Bar& bar : *bars) bar = {1, bar.birth / scale, bar.death / scale};
    const double expected = static_cast<double>(
        std::pow(costs.least(a_in_unit, b_in_unit, used, 0), 1 / Real{costs.order}));
    const WassersteinOptions options{.order = costs.order, .ground = costs.ground};
    const DistanceBounds found = wasserstein_distance(a, b, options);
    SCOPED_TRACE("order " + std::to_string(costs.order) + ", ground " +
                 std::to_string(costs.ground) + ", apart " + std::to_string(apart));
    EXPECT_NEAR(found.value / scale, expected, 1e-9 * expected);
    EXPECT_LE(found.lower, found.value);
    EXPECT_LE(found.lower / scale, expected * (1 + 1e-12));
    // The matching has the stated cost.
    const WassersteinMatching matching = wasserstein_matching(a, b, options);
    Real sum = 0;
    for (const auto& [i, j] : matching.pairs)
      sum += i < 0   ? costs.alone(b_in_unit[static_cast<std::size_t>(j)])
             : j < 0 ? costs.alone(a_in_unit[static_cast<std::size_t>(i)])
                     : costs.pair(a_in_unit[static_cast<std::size_t>(i)],
                                  b_in_unit[static_cast<std::size_t>(j)]);
    EXPECT_NEAR(static_cast<double>(std::pow(sum, 1 / Real{costs.order})), expected,
                1e-9 * expected);
  });
}

TEST(WassersteinScales, PowersThatVanishBesideThatOfTheLongest) {
  const Bars a{{1, 0, 1}}, b{{1, 0, 1 + std::ldexp(1, -40)}};
  for (const double order : {1.0, 2.0, 30.0, 100.0})
    EXPECT_DOUBLE_EQ(wasserstein_distance(a, b, {.order = order}).value, std::ldexp(1, -40));
  const Bars far{{0, 0, kInfinity}, {1, 0, 1}}, near{{0, 1e-20, kInfinity}, {1, 0, 1}};
  for (const double order : {1.0, 2.0, 30.0})
    EXPECT_DOUBLE_EQ(wasserstein_distance(far, near, {.order = order}).value, 1e-20);
}

}  // namespace
}  // namespace ph::test
