// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/projection_centre.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <random>

#include "tests/libsegment/scenery.hpp"
#include "tests/support/test_data.hpp"

namespace ph::segment {
namespace {

using test::kHole;
using test::TableScene;

/// A rotation of the scene and a new position of the sensor.
struct Motion {
  Eigen::Matrix3d rotation;
  Vec3 sensor;

  explicit Motion(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> place(-2, 2);
    double q[4];  // not in one expression, because compilers evaluate arguments in any order
    for (double& c : q) c = normal(random);
    rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    do {
      for (double& c : sensor) c = place(random);
    } while (std::hypot(sensor[0], sensor[1], sensor[2]) < 0.3);
  }
  std::vector<float> of(const std::vector<float>& xyz) const {
    std::vector<float> moved;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      const Eigen::Vector3d p = rotation * Eigen::Vector3d(xyz[i], xyz[i + 1], xyz[i + 2]) +
                                Eigen::Vector3d(sensor[0], sensor[1], sensor[2]);
      for (int k = 0; k < 3; ++k) moved.push_back(static_cast<float>(p[k]));
    }
    return moved;
  }
};

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::optional<Vec3> elsewhere(const std::vector<float>& xyz, const Vec3& viewpoint,
                              Index width = TableScene::kWidth,
                              Index height = TableScene::kHeight) {
  return centre_elsewhere({xyz, viewpoint, width, height});
}

TEST(ProjectionCentre, IsFoundWhereverTheSensorStands) {
  const std::vector<float> xyz = TableScene::two_boxes().xyz();
  EXPECT_FALSE(elsewhere(xyz, {0, 0, 0}));
  EXPECT_FALSE(elsewhere(xyz, {0.02, 0.02, 0.02})) << "a tenth of the range is near enough";
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Motion motion(seed);
    const std::vector<float> moved = motion.of(xyz);
    EXPECT_FALSE(elsewhere(moved, motion.sensor)) << seed;
    const auto found = elsewhere(moved, {0, 0, 0});
    ASSERT_TRUE(found) << seed;
    EXPECT_LT(distance(*found, motion.sensor), 1e-3) << seed;
  }
}

TEST(ProjectionCentre, RoundedCoordinatesDoNotHideIt) {
  const Motion motion(5);
  std::vector<float> rounded = motion.of(TableScene::two_boxes().xyz());
  for (float& c : rounded) c = std::round(c * 1000) / 1000;
  const auto of_rounded = elsewhere(rounded, {0, 0, 0});
  ASSERT_TRUE(of_rounded);
  EXPECT_LT(distance(*of_rounded, motion.sensor), 0.03);
  EXPECT_FALSE(elsewhere(rounded, motion.sensor));
}

// One point in twenty is at a random place. Most sensors are found, and none is found at a wrong
// place.
TEST(ProjectionCentre, OutliersHideItSeldom) {
  constexpr unsigned seeds = 60;
  unsigned count = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Motion motion(seed);
    std::vector<float> moved = motion.of(TableScene::two_boxes().xyz());
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-3, 3);
    for (std::size_t i = 0; i < moved.size(); i += 3) {
      if (random() % 20 != 0) continue;
      for (std::size_t k = 0; k < 3; ++k) moved[i + k] = place(random);
    }
    EXPECT_FALSE(elsewhere(moved, motion.sensor)) << seed;
    const auto found = elsewhere(moved, {0, 0, 0});
    if (!found) continue;
    ++count;
    EXPECT_LT(distance(*found, motion.sensor), 0.1) << seed;
  }
  EXPECT_GT(count, 2 * seeds / 3);
}

TEST(ProjectionCentre, HolesAtTheOriginAreNoReasonForAlarm) {
  std::vector<float> xyz = TableScene::two_boxes().xyz();
  for (float& c : xyz)
    if (std::isnan(c)) c = 0;
  EXPECT_FALSE(elsewhere(xyz, {0, 0, 0}));
}

TEST(ProjectionCentre, NothingIsSaidWhereItCannotBeTold) {
  EXPECT_FALSE(elsewhere(TableScene({}).xyz(), {1, 2, 3})) << "a plane looks alike from anywhere";
  EXPECT_FALSE(elsewhere(std::vector<float>(3 * 320 * 240, kHole), {0, 0, 0}));
  const std::vector<float> spot(3 * 320 * 240, 1);
  EXPECT_FALSE(elsewhere(spot, {0, 0, 0}));
  const std::vector<float> scene = TableScene::two_boxes().xyz();
  EXPECT_FALSE(centre_elsewhere({scene, {3, 3, 3}})) << "it is not organised";
  // A height map, for which the rays are parallel.
  std::vector<float> map;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const bool box = x > 100 && x < 200 && y > 60 && y < 160;
      for (const double c : {x * 0.003, y * 0.003, box ? 0.1 : 0.0})
        map.push_back(static_cast<float>(c));
    }
  }
  EXPECT_FALSE(elsewhere(map, {0.5, 0.4, 1}));
  EXPECT_FALSE(elsewhere(map, {0, 0, 0}));
  // The same points in random order.
  std::vector<float> shuffled;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < scene.size(); i += 3) order.push_back(i);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  for (const std::size_t i : order)
    shuffled.insert(shuffled.end(), {scene[i], scene[i + 1], scene[i + 2]});
  EXPECT_FALSE(elsewhere(shuffled, {0, 0, 0}));
  EXPECT_FALSE(elsewhere(shuffled, {1, 1, 1}));
}

/// The pixels of a picture whose lens bends the rays, in the frame of the sensor.
TEST(ProjectionCentre, ALensIsNoReasonForAlarm) {
  const std::vector<float> straight = TableScene::two_boxes().xyz();
  for (const double k : {-0.3, -0.1, 0.1}) {
    std::vector<float> bent(straight.size(), kHole);
    for (Index v = 0; v < 240; ++v) {
      for (Index u = 0; u < 320; ++u) {
        const double x = (static_cast<double>(u) - 159.5) / 260;
        const double y = (static_cast<double>(v) - 119.5) / 260;
        const double factor = 1 + k * (x * x + y * y);
        const auto column = std::lround(159.5 + 260 * factor * x);
        const auto row = std::lround(119.5 + 260 * factor * y);
        if (column < 0 || column >= 320 || row < 0 || row >= 240) continue;
        std::copy_n(&straight[static_cast<std::size_t>(3 * (row * 320 + column))], 3,
                    &bent[static_cast<std::size_t>(3 * (v * 320 + u))]);
      }
    }
    EXPECT_FALSE(elsewhere(bent, {0, 0, 0})) << k;
  }
}

TEST(ProjectionCentre, IsTakenWhereTheOptionsSayNothing) {
  const std::vector<float> xyz = TableScene::two_boxes().xyz();
  const Segmentation expected = segment(CloudView{xyz, {}, 320, 240});
  EXPECT_FALSE(expected.rays_meet_at);
  ASSERT_EQ(expected.cut.segments.size(), 2U);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Motion motion(seed);
    const std::vector<float> moved = motion.of(xyz);
    const CloudView view{moved, {}, 320, 240};
    const Segmentation s = segment(view);
    ASSERT_TRUE(s.rays_meet_at);
    EXPECT_EQ(s.tree.viewpoint, *s.rays_meet_at);
    EXPECT_LT(distance(s.tree.viewpoint, motion.sensor), 1e-3);
    EXPECT_EQ(s.cut.segments.size(), 2U);
    std::size_t other = 0;
    for (std::size_t i = 0; i < s.cut.labels.size(); ++i)
      other += s.cut.labels[i] != expected.cut.labels[i];
    EXPECT_LT(other, s.cut.labels.size() / 100) << seed;

    const Segmentation obeys = segment(view, {.viewpoint = Vec3{0, 0, 0}});
    EXPECT_EQ(obeys.tree.viewpoint, (Vec3{0, 0, 0}));
    EXPECT_EQ(obeys.rays_meet_at, s.rays_meet_at);
  }
}

TEST(ProjectionCentre, OfRealFrames) {
  namespace fs = std::filesystem;
  const fs::path folder = ph::test::test_data("scenes");
  if (folder.empty()) GTEST_SKIP() << ph::test::no_test_data("scenes");
  unsigned seed = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".pcd") continue;
    SCOPED_TRACE(entry.path().filename());
    const Cloud cloud = read_cloud(entry.path());
    const std::vector<float> xyz = cloud.xyz();
    EXPECT_FALSE(elsewhere(xyz, {0, 0, 0}, cloud.width, cloud.height));
    const Motion motion(++seed);
    const std::vector<float> moved = motion.of(xyz);
    EXPECT_FALSE(elsewhere(moved, motion.sensor, cloud.width, cloud.height));
    const auto found = elsewhere(moved, {0, 0, 0}, cloud.width, cloud.height);
    ASSERT_TRUE(found);
    EXPECT_LT(distance(*found, motion.sensor), 0.02);
  }
}

}  // namespace
}  // namespace ph::segment
