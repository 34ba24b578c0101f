// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/circle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace ph::segment {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::Vector2d kCentre(0.3, -0.7);

/// Points of a circle between two angles.
std::vector<Eigen::Vector2d> arc(double radius, double from, double to, int count = 100) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) {
    const double a = from + (to - from) * i / count;
    points.push_back(kCentre + radius * Eigen::Vector2d(std::cos(a), std::sin(a)));
  }
  return points;
}

TEST(Circle, IsFoundByAnArc) {
  for (const double radius : {0.02, 0.08, 0.25}) {
    for (const double turn : {0.5 * kPi, kPi, 2 * kPi}) {
      const auto points = arc(radius, 0.3, 0.3 + turn);
      const Circle circle = fit_circle({&points});
      EXPECT_NEAR(circle.radius, radius, 1e-9);
      EXPECT_NEAR((circle.centre - kCentre).norm(), 0, 1e-9);
      EXPECT_NEAR(deviation(circle, points), 0, 1e-9);
    }
  }
}

TEST(Circle, IsFoundAmongNoise) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0, 0.002);
  auto points = arc(0.08, 0, 2 * kPi, 2000);
  for (auto& p : points) p += noise(random) * (p - kCentre).normalized();
  const Circle circle = fit_circle({&points});
  EXPECT_NEAR(circle.radius, 0.08, 3e-4);
  EXPECT_NEAR((circle.centre - kCentre).norm(), 0, 3e-4);
  EXPECT_NEAR(deviation(circle, points), 0.002, 2e-4);
}

TEST(Circle, EachSetHasTheSameWeight) {
  // If the points lie on two concentric circles, the radius is between the two radii, however many
  // points each circle has.
  for (const int count : {36, 36 * 50}) {
    const auto small = arc(0.06, 0, 2 * kPi, 36), large = arc(0.1, 0, 2 * kPi, count);
    const Circle circle = fit_circle({&small, &large});
    EXPECT_NEAR(circle.radius, std::sqrt((0.06 * 0.06 + 0.1 * 0.1) / 2), 1e-9);
    EXPECT_NEAR((circle.centre - kCentre).norm(), 0, 1e-9);
  }
}

// The circle fitted to a line is arbitrary, but the line covers at most half of it. A rim must
// cover more than half.
TEST(Circle, ALineIsOnHalfOfItsCircleAtMost) {
  for (int degrees = 0; degrees < 180; ++degrees) {
    const Eigen::Vector2d along(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180));
    std::vector<Eigen::Vector2d> line;
    for (int i = 0; i < 40; ++i) line.emplace_back(kCentre + 0.005 * i * along);
    const Circle circle = fit_circle({&line});
    if (circle.radius > 0) {
      EXPECT_LT(sectors_of(circle, line).count(), 20U) << degrees;
    }
  }
  const std::vector<Eigen::Vector2d> spot(9, kCentre);
  EXPECT_FALSE(fit_circle({&spot}).radius > 0);
}

TEST(Circle, HasSectorsOfTenDegrees) {
  const Circle circle{kCentre, 0.08};
  for (int sectors = 1; sectors <= 36; ++sectors) {
    const auto points = arc(0.08, 1e-6, sectors * kPi / 18 - 1e-6, 1000);
    EXPECT_EQ(sectors_of(circle, points).count(), static_cast<std::size_t>(sectors));
  }
  EXPECT_EQ(sectors_of(circle, {}).count(), 0U);
  const std::vector<Eigen::Vector2d> left = {kCentre - Eigen::Vector2d(0.08, 0),
                                             kCentre - Eigen::Vector2d(0.08, -0.0)};
  EXPECT_EQ(sectors_of(circle, left).count(), 1U) << "half a turn either way is one direction";
}

}  // namespace
}  // namespace ph::segment
