// SPDX-License-Identifier: MIT
#include "ph/significance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "ph/error.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "tests/libph/significance/random_points.hpp"
#include "tests/support/expect_error.hpp"

namespace ph {
namespace {

using test::expect_error;
using test::random_points;

double p_by_definition(const std::vector<Bar>& bars, const Bar& bar, double a) {
  double mean = 0;
  for (const Bar& other : bars)
    mean += a * std::log(std::log(other.death / other.birth)) / static_cast<double>(bars.size());
  const double b = -0.5772156649015329 - mean;
  return std::exp(-std::exp(a * std::log(std::log(bar.death / bar.birth)) + b));
}

TEST(UniversalPValues, AreThoseOfTheDefinition) {
  const std::vector<Bar> bars{{1, 1, 2}, {1, 0.5, 3}, {1, 2, 2.1}, {1, 1.5, 1.75}};
  for (const auto& [filtration, a] :
       {std::pair(DistanceFiltration::rips, 1.0), {DistanceFiltration::cech, 0.5}}) {
    const BarPValues found = universal_p_values(bars, filtration);
    EXPECT_EQ(found.tested, 4U);
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_NEAR(found.p[i], p_by_definition(bars, bars[i], a), 1e-14);
      EXPECT_EQ(found.corrected[i], std::min(1.0, 4 * found.p[i]));
    }
  }
}

TEST(UniversalPValues, DoNotDependOnTheUnit) {
  const std::vector<Bar> radii{{1, 1, 2}, {1, 0.5, 3}, {1, 2, 2.1}};
  std::vector<Bar> diameters, squares;
  for (const Bar& bar : radii) {
    diameters.push_back({1, 2 * bar.birth, 2 * bar.death});
    squares.push_back({1, bar.birth * bar.birth, bar.death * bar.death});
  }
  const auto p = universal_p_values(radii, DistanceFiltration::cech).p;
  for (const auto* other : {&diameters, &squares}) {
    const auto same = universal_p_values(*other, DistanceFiltration::cech).p;
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(same[i], p[i], 1e-13);
  }
}

TEST(UniversalPValues, OfBarsWithoutARatio) {
  const std::vector<Bar> bars{{1, 1, 2}, {1, 3, kInfinity}, {1, 2, 2}, {1, 1, 4}};
  const BarPValues found = universal_p_values(bars, DistanceFiltration::rips);
  EXPECT_EQ(found.tested, 2U);
  EXPECT_TRUE(std::isnan(found.p[1]) && std::isnan(found.corrected[1]));
  EXPECT_EQ(found.p[2], 1);
  const std::vector<Bar> alone{bars[0], bars[3]};
  EXPECT_EQ(found.p[3], universal_p_values(alone, DistanceFiltration::rips).p[1]);
  EXPECT_TRUE(universal_p_values({}, DistanceFiltration::rips).p.empty());
  // A ratio of 10^310 is too large for a double, but its logarithm is not.
  const std::vector<Bar> vast{{1, 1e-300, 1e10}, {1, 1, 2}};
  const double outer[] = {std::log(310 * std::log(10.0)), std::log(std::log(2.0))};
  const double p = std::exp(-std::exp(outer[0] - (outer[0] + outer[1]) / 2 - std::numbers::egamma));
  EXPECT_NEAR(universal_p_values(vast, DistanceFiltration::rips).p[0], p, 1e-12);
  expect_error(ErrorKind::bad_data, "born at 0", [] {
    universal_p_values(std::vector<Bar>{{1, 0, 2}}, DistanceFiltration::rips);
  });
  expect_error(ErrorKind::bad_data, "birth <= death", [] {
    universal_p_values(std::vector<Bar>{{1, 3, 2}}, DistanceFiltration::rips);
  });
  expect_error(ErrorKind::bad_data, "birth <= death", [] {
    universal_p_values(std::vector<Bar>{{1, std::nan(""), 2}}, DistanceFiltration::rips);
  });
}

TEST(UniversalPValues, AreUniformForNoise) {
  std::mt19937 random(5);
  for (const Index dimension : {2, 3}) {
    std::vector<double> all;
    for (int round = 0; round < 4; ++round) {
      const Barcode barcode =
          persistence(Rips(random_points(random, 400, dimension)), {.max_dim = 1});
      const auto bars = barcode.bars(1);
      const BarPValues found = universal_p_values(bars, DistanceFiltration::rips);
      EXPECT_GT(std::ranges::min(found.corrected), 0.01);
      all.insert(all.end(), found.p.begin(), found.p.end());
    }
    std::ranges::sort(all);
    // Computes the Kolmogorov-Smirnov statistic of a few hundred bars, which are not independent of
    // each other.
    double largest = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      largest = std::max(
          largest, std::abs(all[i] - static_cast<double>(i) / static_cast<double>(all.size())));
    EXPECT_LT(largest, 0.08) << all.size() << " bars";
  }
}

TEST(UniversalPValues, FindTheLoopOfANoisyCircle) {
  std::mt19937 random(6);
  std::normal_distribution<> noise(0, 0.1);
  Points points(200, 2);
  for (Index i = 0; i < 200; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 200;
    points(i, 0) = std::cos(angle) + noise(random);
    points(i, 1) = std::sin(angle) + noise(random);
  }
  const Barcode barcode = persistence(Rips(points), {.max_dim = 1});
  const auto bars = barcode.bars(1);
  const auto corrected = universal_p_values(bars, DistanceFiltration::rips).corrected;
  const auto longest = std::ranges::max_element(bars, {}, &Bar::persistence) - bars.begin();
  for (std::size_t i = 0; i < corrected.size(); ++i)
    EXPECT_EQ(corrected[i] < 0.05, static_cast<std::ptrdiff_t>(i) == longest) << corrected[i];
}

}  // namespace
}  // namespace ph
