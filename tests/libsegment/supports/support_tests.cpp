// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "ph/error.hpp"
#include "ph/label_tracker.hpp"
#include "tests/libsegment/supports/room.hpp"

namespace ph::segment {
namespace {

using namespace test;

TEST(Support, IsNotTheLargerWallBehindIt) {
  const Block table{{-0.4, -0.45, -0.02}, {0.4, 0.25, 0}}, wall{{-2, 0.25, -0.5}, {2, 0.27, 2}};
  const Room room({table, kLeft, kRight, wall});
  const Segmentation s = room.segmented();
  ASSERT_TRUE(s.tree.plane);
  EXPECT_LT(s.tree.plane->share, 0.5) << "the wall has more points";
  expect_direction(s.tree.plane->normal, {0, 0, 1});
  EXPECT_EQ(s.cut.segments.size(), 2U);
  EXPECT_GT(room.share_on(s, 3, 2), 0.7);
}

TEST(Support, IsNotASideOfAnObject) {
  const Block box{{-0.15, -0.1, -0.2}, {0.15, 0.2, 0.1}};
  const Room room({box});
  const Segmentation s = room.segmented();
  EXPECT_FALSE(s.tree.plane);
  EXPECT_NE(s.plane_note.find("goes on behind"), std::string::npos) << s.plane_note;
  EXPECT_EQ(s.cut.segments.size(), 1U);
  EXPECT_EQ(s.cut.segments[0].role, Role::object);
}

TEST(Support, IsNotACardInTheAir) {
  const Block card{{-0.1, -0.1, 0}, {0.1, 0.1, 0.002}};
  const Segmentation alone = Room({card}).segmented();
  EXPECT_FALSE(alone.tree.plane);
  EXPECT_NE(alone.plane_note.find("nothing is on it"), std::string::npos) << alone.plane_note;
  EXPECT_EQ(alone.cut.segments.size(), 1U);
  // A larger plane is found, because it is an empty table.
  EXPECT_TRUE(Room({kTable}).segmented().tree.plane);
  // A small tray with something in its middle is a support.
  const Block tray{{-0.2, -0.2, -0.01}, {0.2, 0.2, 0}}, cube{{-0.03, -0.03, 0}, {0.03, 0.03, 0.06}};
  const Segmentation with_cube = Room({tray, cube}).segmented();
  EXPECT_TRUE(with_cube.tree.plane);
  EXPECT_EQ(with_cube.cut.segments.size(), 1U);
}

/// A sampled can without a table, 20 cm high and 80 cm in front of the sensor: points on the nearer
/// part of its wall, in no order.
std::vector<float> wall_of_can(double radius, double noise, double angle, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> around(-angle, angle), up(-0.1, 0.1);
  std::normal_distribution<double> gauss(0, noise);
  std::vector<float> xyz;
  for (int i = 0; i < 10000; ++i) {
    const double a = around(random);
    for (const double x : {radius * std::sin(a), up(random), 0.8 - radius * std::cos(a)})
      xyz.push_back(static_cast<float>(noise > 0 ? x + gauss(random) : x));
  }
  return xyz;
}

TEST(Support, IsNotTheWallOfACan) {
  constexpr double half = std::numbers::pi / 2;
  for (const double radius : {0.03, 0.04, 0.06})
    for (const double noise : {0.0, 0.001})
      for (const double angle : {half, half + 0.12, 2 * half})
        for (unsigned seed = 0; seed < 5; ++seed) {
          SCOPED_TRACE(fmt::format("{} {} {} {}", radius, noise, angle, seed));
          const std::vector<float> xyz = wall_of_can(radius, noise, angle, seed);
          const auto points = static_cast<Index>(xyz.size() / 3);
          const Segmentation s = segment(CloudView{.xyz = xyz});
          Index kept = 0;
          for (const Segment& found : s.cut.segments) kept += found.points;
          EXPECT_GT(kept, points * 9 / 10) << s.plane_note;
        }
}

// ---- from frame to frame

TEST(PlaneGuess, IsTakenWhileThePointsAgree) {
  const Room room({kTable, kLeft, kRight});
  const Segmentation alone = room.segmented();
  Plane guess = *alone.tree.plane;
  guess.offset += 0.001;  // the amount by which noise may move the plane
  const Segmentation next = room.segmented({.plane_guess = guess});
  EXPECT_EQ(next.cut.labels, alone.cut.labels);
  EXPECT_NEAR(next.tree.plane->offset, alone.tree.plane->offset, 1e-4) << "it is fitted again";
  // If the plane is far from the guess, the search starts from scratch.
  guess.offset += 0.3;
  EXPECT_EQ(room.segmented({.plane_guess = guess}).tree.plane, alone.tree.plane);
  guess.normal = {1, 1, 0};
  EXPECT_THROW(room.segmented({.plane_guess = guess}), Error);
}

TEST(CameraMotion, IsToldFromThePlane) {
  SceneTree before, after;
  EXPECT_FALSE(camera_motion(before, after));
  before.plane = Plane{{0, 0, 1}, -0.9};
  before.viewpoint = {0, 0, 1.9};  // one metre above the plane
  EXPECT_FALSE(camera_motion(before, after)) << "one has no plane";
  after = before;
  EXPECT_FALSE(camera_motion(before, after));
  const auto turned = [&](double degrees) {
    const double a = degrees * std::acos(-1.0) / 180;
    // A rotation about the foot of the viewpoint keeps the distance to the plane.
    SceneTree scene = before;
    scene.plane = Plane{{std::sin(a), 0, std::cos(a)}, 1 - 1.9 * std::cos(a)};
    return camera_motion(before, scene);
  };
  EXPECT_FALSE(turned(0.4));
  ASSERT_TRUE(turned(0.6));
  EXPECT_NEAR(turned(30)->turn, 30, 1e-9);
  EXPECT_NEAR(turned(30)->shift, 0, 1e-9);
  EXPECT_NEAR(turned(180)->turn, 180, 1e-9);
  after.viewpoint[2] -= 0.02;
  ASSERT_TRUE(camera_motion(before, after));
  EXPECT_NEAR(camera_motion(before, after)->shift, -0.02, 1e-12);
  after.viewpoint[2] += 0.016;  // 4 mm in total
  EXPECT_FALSE(camera_motion(before, after));
  before.viewpoint[2] += 2, after = before;  // at three metres, the noise is nine times as large
  after.viewpoint[2] += 0.04;
  EXPECT_FALSE(camera_motion(before, after));
}

}  // namespace
}  // namespace ph::segment
