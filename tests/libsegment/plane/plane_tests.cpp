// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "libsegment/src/plane/stages.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using test::all_of;

/// Points of the plane z = 1 + 0.5 y with noise, seen from the origin. The first `outliers` points
/// are not on the plane.
std::vector<float> tilted_plane(int count, int outliers, double noise) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  std::normal_distribution<double> error(0, noise > 0 ? noise : 1);
  std::vector<float> xyz;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random);
    const double z =
        i < outliers ? 0.8 + 0.4 * place(random) : 1 + 0.5 * y + (noise > 0 ? error(random) : 0);
    for (const double c : {x, y, z}) xyz.push_back(static_cast<float>(c));
  }
  return xyz;
}

TEST(Plane, IsFoundAmongNoiseAndOutliers) {
  for (const int outliers : {0, 5000, 10000, 15000}) {
    const std::vector<float> xyz = tilted_plane(20000, outliers, 0.001);
    const PlaneSearch search = find_plane({xyz, {}}, all_of(xyz), {0.006});
    ASSERT_TRUE(search.plane) << search.note;
    const double length = std::sqrt(1.25);  // length of (0, 0.5, -1)
    EXPECT_NEAR(search.plane->normal[0], 0, 0.002);
    EXPECT_NEAR(search.plane->normal[1], 0.5 / length, 0.002);
    EXPECT_NEAR(search.plane->normal[2], -1 / length, 0.002);
    EXPECT_NEAR(search.plane->offset, 1 / length, 0.001);
    EXPECT_NEAR(search.plane->share, 1 - outliers / 20000.0, 0.05);
  }
}

TEST(Plane, TellsHowNoisyItsPointsAre) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  std::normal_distribution<double> gauss;
  for (const double noise : {0.0, 0.001, 0.003, 0.005}) {
    std::vector<float> xyz;
    for (int i = 0; i < 20000; ++i) {  // the plane z = 1, and objects on it
      const double x = place(random), y = place(random), square = x * x + y * y + 1;
      const double object = i % 3 == 0 ? -0.1 * std::abs(place(random)) : 0;
      for (const double c : {x, y, 1 + object + noise * square * gauss(random)})
        xyz.push_back(static_cast<float>(c));
    }
    const PlaneSearch search = find_plane({xyz, {}}, all_of(xyz), {0.005});
    ASSERT_TRUE(search.plane) << search.note;
    EXPECT_NEAR(search.noise, noise, 0.15 * noise + 3e-4);
  }
}

TEST(Plane, LooksAtTheSensor) {
  const std::vector<float> xyz = tilted_plane(1000, 0, 0);
  for (const Vec3& viewpoint : {Vec3{0, 0, 0}, Vec3{0, 0, 3}}) {
    const PlaneSearch search = find_plane({xyz, viewpoint}, all_of(xyz), {0.006});
    ASSERT_TRUE(search.plane);
    EXPECT_GT(search.plane->signed_distance(viewpoint[0], viewpoint[1], viewpoint[2]), 0);
  }
}

TEST(Plane, RemovesItselfAndWhatLiesBehind) {
  std::vector<float> xyz = tilted_plane(1000, 0, 0);
  // Three points: in front of the plane, behind the plane, and on it.
  xyz.insert(xyz.end(), {0, 0, 0.9F, 0, 0, 1.1F, 0, 0, 0.999F});
  const CloudView cloud{xyz, {}};
  const PlaneSearch search = find_plane(cloud, all_of(xyz), {0.006});
  ASSERT_TRUE(search.plane);
  EXPECT_EQ(remove_plane(cloud, all_of(xyz), *search.plane, {0.006}).beyond,
            (std::vector<Index>{1000}));
}

TEST(Plane, DoesNotDependOnOrderDuplicatesOrPowersOfTwo) {
  const std::vector<float> xyz = tilted_plane(20000, 8000, 0.002);
  const Plane plane = find_plane({xyz, {}}, all_of(xyz), {0.006}).plane.value();

  std::vector<std::size_t> order(xyz.size() / 3);
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  std::vector<float> shuffled, scaled, twice = xyz;
  for (const std::size_t i : order) {
    for (std::size_t k = 0; k < 3; ++k) shuffled.push_back(xyz[3 * i + k]);
  }
  twice.insert(twice.end(), xyz.begin(), xyz.end());
  for (const float c : xyz) scaled.push_back(c * 64);

  const auto same = [&](const Plane& other, double scale) {
    return other.normal == plane.normal && other.offset == scale * plane.offset &&
           other.share == plane.share;
  };
  EXPECT_TRUE(same(find_plane({shuffled, {}}, all_of(shuffled), {0.006}).plane.value(), 1));
  EXPECT_TRUE(same(find_plane({twice, {}}, all_of(twice), {0.006}).plane.value(), 1));
  EXPECT_TRUE(same(find_plane({scaled, {}}, all_of(scaled), {0.006 * 64}).plane.value(), 64));
}

TEST(Plane, SaysWhyThereIsNone) {
  const std::vector<float> two = {0, 0, 1, 0, 1, 1};
  EXPECT_NE(find_plane({two, {}}, all_of(two), {0.006}).note.find("fewer than three"),
            std::string::npos);
  std::vector<float> line, spot;
  for (int i = 0; i < 100; ++i) {
    line.insert(line.end(), {static_cast<float>(i) * 0.01F, 0, 1});
    spot.insert(spot.end(), {0.5F, 0.5F, 0.5F});
  }
  EXPECT_NE(find_plane({line, {}}, all_of(line), {0.006}).note.find("line"), std::string::npos);
  EXPECT_NE(find_plane({spot, {}}, all_of(spot), {0.006}).note.find("at one point"),
            std::string::npos);
  EXPECT_FALSE(find_plane({{}, {}}, {}, {0.006}).plane);

  std::mt19937 random(1);
  std::normal_distribution<float> any(0, 1);
  std::vector<float> ball;
  for (int i = 0; i < 30000; ++i) ball.push_back(any(random));
  const PlaneSearch search = find_plane({ball, {}}, all_of(ball), {0.006});
  EXPECT_FALSE(search.plane);
  EXPECT_NE(search.note.find("largest candidate holds"), std::string::npos);
}

TEST(Plane, HundredThousandsOfDuplicatesAreOnePoint) {
  std::vector<float> xyz = tilted_plane(500, 0, 0);
  for (int i = 0; i < 300000; ++i) xyz.insert(xyz.end(), {0.1F, 0.1F, 0.5F});
  const PlaneSearch search = find_plane({xyz, {}}, all_of(xyz), {0.006});
  ASSERT_TRUE(search.plane) << search.note;
  EXPECT_NEAR(search.plane->normal[1], 0.5 / std::sqrt(1.25), 1e-4);
}

}  // namespace
}  // namespace ph::segment
