// SPDX-License-Identifier: MIT
#include "libsegment/src/surface/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

/// Values at evenly spaced ranges from `begin` to `end`, in random order.
struct Measurement {
  std::vector<double> ranges, values;

  void add(int count, double begin, double end, const auto& value_of) {
    for (int i = 0; i < count; ++i) {
      ranges.push_back(begin + (end - begin) * i / count);
      values.push_back(value_of(i));
    }
  }
  ConcavityNoise noise() const { return {ranges, values}; }
};

TEST(ConcavityNoise, OfNothingIsTypical) {
  for (const int count : {0, 1, 299}) {  // with fewer than 300 values, a quantile says little
    Measurement few;
    few.add(count, 0.5, 1, [](int) { return 0.07; });
    EXPECT_TRUE(few.noise().measured().empty());
    for (const double range : {0.3, 1.0, 2.0})
      EXPECT_NEAR(few.noise().at(range), 0.03 * range * range, 1e-12) << "as the noise of depth";
    EXPECT_EQ(few.noise().at(0), 0.001);
  }
  Measurement enough;
  enough.add(300, 0.5, 1, [](int) { return 0.07; });
  EXPECT_EQ(enough.noise().measured().size(), 1U);
  EXPECT_EQ(enough.noise().at(enough.ranges[150]), 0.07);
}

TEST(ConcavityNoise, IsAboveFiveSixthsOfTheValues) {
  Measurement m;
  m.add(500, 0.5, 1.5, [](int i) { return i * 7 % 500 / 5000.0; });
  const std::vector<NoiseAt> measured = m.noise().measured();
  ASSERT_EQ(measured.size(), 1U);
  EXPECT_EQ(measured[0].range, m.ranges[250]);
  EXPECT_EQ(measured[0].concavity, 420 / 5000.0);
  EXPECT_EQ(std::ranges::count_if(m.values, [](double x) { return x < 0.084; }), 420);
}

TEST(ConcavityNoise, IsMeasuredAtRangesWithAsManyVoxelsEach) {
  Measurement m;
  m.add(1500, 0.5, 0.6, [](int) { return 0.02; });
  m.add(900, 0.6, 2, [](int) { return 0.05; });
  const ConcavityNoise noise = m.noise();
  ASSERT_EQ(noise.measured().size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(noise.measured()[k].concavity, k < 5 ? 0.02 : 0.05);
    EXPECT_EQ(noise.measured()[k].range, m.ranges[300 * k + 150]);
  }
  m.add(100000, 2, 3, [](int) { return 0.05; });
  EXPECT_EQ(m.noise().measured().size(), 8U);
}

TEST(ConcavityNoise, IsInterpolatedAndChangesWithTheSquareElsewhere) {
  Measurement m;
  m.add(300, 0.5, 0.7, [](int) { return 0.02; });
  m.add(300, 1.3, 1.5, [](int) { return 0.05; });
  const ConcavityNoise noise = m.noise();
  const double near = m.ranges[150], far = m.ranges[450];
  EXPECT_NEAR(noise.at(0.5 * near), 0.02 / 4, 1e-12);
  EXPECT_EQ(noise.at(near), 0.02);
  EXPECT_EQ(noise.at(far), 0.05);
  EXPECT_NEAR(noise.at(near + 0.5 * (far - near)), 0.035, 1e-12);
  EXPECT_NEAR(noise.at(near + 0.9 * (far - near)), 0.047, 1e-12);
  EXPECT_NEAR(noise.at(1.2 * far), 0.05 * 1.44, 1e-12);
}

TEST(ConcavityNoise, IsNeverZero) {
  Measurement quiet;
  quiet.add(300, 0.9, 1.1, [](int) { return 0.0; });
  for (const double range : {0.0, 1.0, 1.5, 1e30}) EXPECT_EQ(quiet.noise().at(range), 0.001);
  Measurement loud;
  loud.add(300, 0.9, 1.1, [](int) { return 0.1; });
  EXPECT_EQ(loud.noise().at(0), 0.001) << "of a point at the viewpoint";
  EXPECT_NEAR(loud.noise().at(10), 0.1 * 100, 1e-9);
}

TEST(ConcavityNoise, DoesNotDependOnTheOrder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 0.1);
  Measurement m;  // many values at the same range
  m.add(5000, 0.5, 2, [&](int) { return any(random); });
  for (double& r : m.ranges) r = std::round(r * 20) / 20;
  std::vector<std::size_t> order(m.ranges.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::shuffle(order, random);
  Measurement shuffled;
  for (const std::size_t i : order) {
    shuffled.ranges.push_back(m.ranges[i]);
    shuffled.values.push_back(m.values[i]);
  }
  const auto a = m.noise().measured(), b = shuffled.noise().measured();
  ASSERT_EQ(a.size(), 8U);
  ASSERT_EQ(b.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(a[k].range, b[k].range);
    EXPECT_EQ(a[k].concavity, b[k].concavity);
  }
}

// ---- in a whole scene

/// Two boxes on a table, seen by a sensor whose depth has this noise at one metre.
std::vector<float> noisy_table(double noise) {
  std::mt19937 random(8);
  std::normal_distribution<double> gauss;
  std::vector<float> xyz = test::TableScene::two_boxes().xyz();
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double depth = xyz[i + 2], other = depth + noise * depth * depth * gauss(random);
    for (std::size_t k = 0; k < 3; ++k) xyz[i + k] *= static_cast<float>(other / depth);
  }
  return xyz;
}

std::vector<NoiseAt> noise_of(const std::vector<float>& xyz, Method method = Method::surface) {
  return segment(CloudView{xyz, {}}, {.method = method, .check = false}).tree.noise;
}

TEST(NoiseOfScenes, DoublesWithThatOfTheSensor) {
  double before = 0;
  for (const double noise : {0.0008, 0.0016, 0.0032}) {
    const std::vector<NoiseAt> found = noise_of(noisy_table(noise));
    ASSERT_GE(found.size(), 5U);
    EXPECT_TRUE(std::ranges::is_sorted(found, {}, &NoiseAt::range));
    EXPECT_GT(found.back().concavity, 1.5 * found.front().concavity) << "it is farther away";
    // Averages over several ranges, because the result at each range depends on the position of the
    // grid relative to the plane.
    double mean = 0;
    for (const NoiseAt& at : found) mean += at.concavity / static_cast<double>(found.size());
    if (before > 0) {
      EXPECT_NEAR(mean / before, 2, 0.35) << noise;
    }
    before = mean;
  }
}

TEST(NoiseOfScenes, IsNoneOfAPerfectSensor) {
  for (const NoiseAt& at : noise_of(noisy_table(0))) EXPECT_LT(at.concavity, 1e-4);
}

TEST(NoiseOfScenes, IsLookedForByMethodSurfaceOnAPlane) {
  const std::vector<float> xyz = noisy_table(0.001);
  EXPECT_FALSE(noise_of(xyz).empty());
  EXPECT_TRUE(noise_of(xyz, Method::paper).empty());
  EXPECT_TRUE(noise_of(xyz, Method::supervoxels).empty());
  EXPECT_TRUE(segment(CloudView{xyz, {}}, {.plane = false, .check = false}).tree.noise.empty());
}

TEST(NoiseOfScenes, DoesNotDependOnTheOrderOfThePoints) {
  const std::vector<float> xyz = noisy_table(0.001);
  std::vector<std::size_t> order(xyz.size() / 3);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::shuffle(order, std::mt19937(4));
  std::vector<float> shuffled;
  for (const std::size_t i : order)
    for (std::size_t k = 0; k < 3; ++k) shuffled.push_back(xyz[3 * i + k]);
  const auto a = noise_of(xyz), b = noise_of(shuffled);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].range, b[k].range);
    EXPECT_EQ(a[k].concavity, b[k].concavity);
  }
}

}  // namespace
}  // namespace ph::segment
