// SPDX-License-Identifier: MIT
// Method surface on small scenes with known answers. surface_stages_tests.cpp tests its stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <random>

#include "libsegment/src/methods.hpp"
#include "libsegment/src/objects/objects.hpp"
#include "ph/error.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::segment {
namespace {

using test::kHole;
using test::TableScene;

/// Checks that most points of each block (at least `share`) have the same label, and that different
/// blocks have different labels.
void expect_blocks_apart(const TableScene& scene, const Segmentation& s, double share) {
  std::map<int, std::map<std::uint32_t, Index>> labels;
  std::map<int, Index> sizes;
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
    if (scene.truth()[i] <= 0) continue;
    ++labels[scene.truth()[i]][s.cut.labels[i]];
    ++sizes[scene.truth()[i]];
  }
  std::map<std::uint32_t, int> owner;
  for (const auto& [block, counts] : labels) {
    const auto most = std::ranges::max_element(
        counts, [](const auto& a, const auto& b) { return a.second < b.second; });
    EXPECT_GE(static_cast<double>(most->second), share * static_cast<double>(sizes[block]))
        << "block " << block;
    EXPECT_NE(most->first, 0U) << "block " << block;
    EXPECT_TRUE(owner.emplace(most->first, block).second) << "two blocks, one label";
  }
}

TEST(Surface, ObjectsThatStandOnEachOtherComeApart) {
  const TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  ASSERT_EQ(s.cut.segments.size(), 2U);
  expect_blocks_apart(scene, s, 0.95);
  // The two segments meet at the seam, and each names the other as its neighbour.
  EXPECT_EQ(s.cut.segments[0].neighbour, 2U);
  EXPECT_EQ(s.cut.segments[1].neighbour, 1U);
  EXPECT_EQ(s.cut.segments[0].meets_at, s.cut.segments[1].meets_at);
  EXPECT_GT(s.cut.segments[0].meets_at, 10);  // in units of the noise
  EXPECT_GT(s.cut.segments[1].persistence, 10);
  EXPECT_LE(s.cut.segments[1].persistence, s.cut.segments[1].meets_at);
  EXPECT_EQ(s.difference, "");
  // By distance alone, the two boxes are one segment.
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}, {.method = Method::paper}).cut.segments.size(), 1U);
}

TEST(Surface, AnObjectThatLeansOnAnotherComesApart) {
  const TableScene scene(
      {{{-0.1, 0.05, 0}, {0.1, 0.2, 0.2}}, {{-0.06, -0.1, 0}, {0.05, 0.05, 0.08}}});
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  ASSERT_EQ(s.cut.segments.size(), 2U);
  expect_blocks_apart(scene, s, 0.95);
}

TEST(Surface, TheCutFollowsPersistenceAndSize) {
  const TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation s = segment(cloud);
  const double persistence = s.cut.segments[1].persistence;
  EXPECT_EQ(segment(cloud, {.min_persistence = 1.01 * persistence}).cut.segments.size(), 1U);
  // No place of the seam is lower than this value, so half of the value still separates the boxes.
  EXPECT_EQ(segment(cloud, {.min_persistence = 0.49 * persistence}).cut.segments.size(), 2U);
  EXPECT_EQ(segment(cloud, {.min_part = s.cut.segments[1].voxels + 50}).cut.segments.size(), 1U);
  // The stored tree gives the same result.
  const std::vector<Index> basins = s.tree.merge_tree.basins(1.01 * persistence, 200);
  EXPECT_EQ(std::ranges::count(basins, basins[0]), static_cast<Index>(basins.size()));
  const std::vector<Index> apart = s.tree.merge_tree.basins(0.99 * persistence, 200);
  EXPECT_LT(std::ranges::count(apart, apart[0]), static_cast<Index>(apart.size()));
}

TEST(Surface, WhereSegmentsMeetFirst) {
  const TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  const auto meeting = first_meeting(s, 1, 2);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->value, s.cut.segments[0].meets_at);
  const auto& [x, y, z] = meeting->at;  // on the seam, at the top of the lower box
  EXPECT_NEAR(s.tree.plane->signed_distance(x, y, z), 0.08, 0.01);
  EXPECT_FALSE(first_meeting(segment(CloudView{TableScene::two_boxes().xyz(), {}}), 1, 2));
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 3}, std::pair{2, 2}})
    EXPECT_THROW(first_meeting(s, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)),
                 Error);
}

TEST(Surface, SeparateObjectsMeetNobody) {
  const Segmentation s = segment(CloudView{TableScene::two_boxes().xyz(), {}});
  ASSERT_EQ(s.cut.segments.size(), 2U);
  for (const Segment& g : s.cut.segments) {
    EXPECT_EQ(g.neighbour, 0U);
    EXPECT_EQ(g.meets_at, kInfinity);
    EXPECT_EQ(g.persistence, kInfinity);
  }
}

TEST(Surface, FeetAreWonBackFromThePlane) {
  std::vector<test::Block> blocks;  // boxes whose feet the rows of pixels meet at several heights
  for (int i = 0; i < 5; ++i) {
    const double x = 0.11 * i - 0.27, y = 0.0011 * i - 0.05;
    blocks.push_back({{x, y, 0}, {x + 0.08, y + 0.08, 0.1}});
  }
  const TableScene scene(blocks);
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  ASSERT_EQ(s.cut.segments.size(), blocks.size());
  expect_blocks_apart(scene, s, 0.95);
  Index within = 0, won = 0, lost = 0;
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
    const float* p = &scene.xyz()[3 * i];
    const double height = s.tree.plane->signed_distance(p[0], p[1], p[2]);
    if (scene.truth()[i] > 0 && height > 0.001 && height <= 0.005) {
      ++within;
      won += s.cut.labels[i] != 0;
    }
    lost += scene.truth()[i] == 0 && s.cut.labels[i] != 0;
  }
  EXPECT_GT(within, 30);
  EXPECT_GT(static_cast<double>(won), 0.9 * static_cast<double>(within));
  EXPECT_EQ(lost, 0);
}

TEST(Surface, CoarseSamplesGetLargerVoxels) {
  const TableScene scene = TableScene::two_boxes();
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}).tree.voxel, 0.005);
  std::vector<float> xyz = scene.xyz();
  for (Index v = 0; v < scene.kHeight; ++v)
    for (Index u = 0; u < scene.kWidth; ++u)
      if (u % 4 != 0 || v % 4 != 0) xyz[3 * static_cast<std::size_t>(v * scene.kWidth + u)] = kHole;
  const Segmentation s = segment(CloudView{xyz, {}});
  EXPECT_GT(s.tree.voxel, 0.005);
  EXPECT_LE(s.tree.voxel, 0.026);
  EXPECT_EQ(s.cut.segments.size(), 2U);
  // If a voxel size is requested, it is used.
  EXPECT_EQ(segment(CloudView{xyz, {}}, {.voxel = 0.005}).tree.voxel, 0.005);
}

/// A strip of 10 x 140 mm with one point per millimetre, seen from 70 cm. @param times copies of
/// each point.
std::vector<float> strip(int times) {
  std::vector<float> xyz;
  for (int i = 0; i < 140 * times; ++i)
    for (int k = 0; k < 10; ++k)
      xyz.insert(xyz.end(),
                 {0.001F * static_cast<float>(i % 140), 0.001F * static_cast<float>(k), 0.7F});
  return xyz;
}

TEST(Surface, AThinThingAloneIsNotASparseSample) {
  for (const int times : {1, 3}) {
    const Segmentation s = segment(CloudView{strip(times), {}}, {.plane = false});
    EXPECT_EQ(s.tree.voxel, 0.005);
    ASSERT_EQ(s.cut.segments.size(), 1U);
    EXPECT_EQ(s.cut.segments[0].points, 1400 * times);
  }
  // If points of a plane are so far apart that their voxels do not touch, they are sparse, even if
  // each point occurs several times.
  for (const int times : {1, 5}) {
    std::vector<float> xyz;
    for (int i = 0; i < 40 * 40 * times; ++i)
      xyz.insert(xyz.end(), {0.009F * static_cast<float>(i % 40),
                             0.009F * static_cast<float>(i / 40 % 40), 0.7F});
    const Segmentation s = segment(CloudView{xyz, {}}, {.plane = false});
    EXPECT_GT(s.tree.voxel, 0.005);
    EXPECT_EQ(s.cut.segments.size(), 1U);
    // Each stage is listed once, although the grid was built several times.
    EXPECT_EQ(std::ranges::count(s.stages, "voxel grid", &Stage::name), 1);
    EXPECT_EQ(std::ranges::count(s.stages, "neighbours", &Stage::name), 1);
    EXPECT_EQ(std::ranges::find(s.stages, "voxel grid", &Stage::name)->points,
              s.tree.vertices.rows());
  }
}

/// Two boxes on a table, scaled. The noise of depth grows with the square of the range. In the
/// middle of the table, its standard deviation is `deviation`.
std::vector<float> noisy_boxes(double scale, double deviation) {
  std::vector<float> xyz = TableScene::two_boxes().xyz();
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, deviation / scale);
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double z = xyz[i + 2], factor = scale * (1 + noise(random) * z);
    for (std::size_t k = 0; k < 3; ++k) xyz[i + k] = static_cast<float>(factor * xyz[i + k]);
  }
  return xyz;
}

TEST(Surface, ThePlaneIsAsThickAsItsNoiseWhereItLies) {
  // With so much noise, the plane is searched for a second time. This must work near the sensor and
  // far from it.
  const TableScene scene = TableScene::two_boxes();
  for (const double range : {0.3, 2.0}) {
    const Segmentation s =
        segment(CloudView{noisy_boxes(range, 0.004), {}}, {.max_range = 10, .check = false});
    ASSERT_TRUE(s.tree.plane) << range;
    EXPECT_NEAR(s.tree.plane->normal[1], -std::sqrt(0.5), 0.02) << range;
    EXPECT_NEAR(s.tree.plane->offset, range * std::sqrt(0.5), 0.003) << range;
    double table = 0, left_of_table = 0, high = 0, left_of_high = 0;
    for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
      const bool kept = std::ranges::binary_search(s.tree.points, static_cast<Index>(i));
      const float* p = &scene.xyz()[3 * i];
      // The height above the table without noise.
      const double height = std::sqrt(0.5) * (1 - p[2] - p[1]) * range;
      table += scene.truth()[i] == 0;
      left_of_table += scene.truth()[i] == 0 && kept;
      if (scene.truth()[i] <= 0 || height < 0.8 * 0.1 * range) continue;
      ++high;
      left_of_high += kept;
    }
    EXPECT_LT(left_of_table, 0.02 * table) << range;
    EXPECT_GT(left_of_high, 0.8 * high) << range;
  }
}

TEST(Surface, ASmallerPlaneDistanceGoesBeforeTheNoiseFloor) {
  // A sheet on the table, four millimetres thick, without noise.
  const TableScene scene(std::vector<test::Block>{{{-0.1, -0.1, 0}, {0.1, 0.1, 0.004}}});
  const CloudView cloud{scene.xyz(), {}};
  EXPECT_TRUE(segment(cloud).cut.segments.empty());
  EXPECT_TRUE(segment(cloud, {.plane_distance = 0.01}).cut.segments.empty());
  EXPECT_EQ(segment(cloud, {.plane_distance = 0.002}).cut.segments.size(), 1U);
  EXPECT_EQ(segment(cloud, {.plane_distance = 0.002, .plane_noise = 0}).cut.segments.size(), 1U);
  EXPECT_EQ(segment(cloud, {.plane_distance = 0.003, .plane_noise = 0.002}).cut.segments.size(),
            1U);
  EXPECT_TRUE(segment(cloud, {.plane_distance = 0.003, .plane_noise = 0.003}).cut.segments.size() <=
              1U);
}

TEST(Surface, NoiseThatGrowsWithTheRangeLeavesTheTableEmpty) {
  // The noise is like the noise of a disparity sensor, with a standard deviation of 1.4 mm at one
  // metre.
  TableScene scene = TableScene::two_boxes();
  std::vector<float> xyz = scene.xyz();
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.0014);
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double z = xyz[i + 2], factor = 1 + noise(random) * z;
    for (std::size_t k = 0; k < 3; ++k) xyz[i + k] = static_cast<float>(factor * xyz[i + k]);
  }
  const Segmentation s = segment(CloudView{xyz, {}});
  EXPECT_EQ(s.cut.segments.size(), 2U);
  expect_blocks_apart(scene, s, 0.9);
}

TEST(Surface, HalfABallIsOne) {
  std::vector<float> xyz;  // half of a ball with a radius of 8 cm, towards the origin
  constexpr int steps = 120;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const double a = std::numbers::pi * i / steps, b = std::numbers::pi * k / steps;
      xyz.push_back(static_cast<float>(0.08 * std::cos(a)));
      xyz.push_back(static_cast<float>(0.08 * std::sin(a) * std::cos(b)));
      xyz.push_back(static_cast<float>(0.8 - 0.08 * std::sin(a) * std::sin(b)));
    }
  }
  EXPECT_EQ(segment(CloudView{xyz, {}}, {.plane = false}).cut.segments.size(), 1U);
}

/// Specks of nine voxels with gaps between them, which partly hide a wall of specks behind them.
/// This scene has very many parts.
std::vector<float> specks(int a_side) {
  std::vector<float> xyz;
  for (const double depth : {0.7, 0.8}) {
    for (int i = 0; i < a_side; ++i)
      for (int k = 0; k < a_side; ++k)
        for (int dot = 0; dot < 81; ++dot)
          for (const double c : {(0.03 * i + 0.0016 * (dot % 9)) * depth,
                                 (0.03 * k + 0.0016 * (dot / 9)) * depth, depth})
            xyz.push_back(static_cast<float>(c));
  }
  return xyz;
}

TEST(Objects, ManySpecksTakeBoundedTimeAndCanBeStopped) {
  using Clock = std::chrono::steady_clock;
  const std::vector<float> xyz = specks(35);
  const SegmentOptions o{
      .min_size = 1, .max_range = 10, .plane = false, .check = false, .min_part = 1};
  const auto start = Clock::now();
  const Segmentation s = segment(CloudView{xyz, {}}, o);
  const std::chrono::duration<double> took = Clock::now() - start;
  std::cout << s.cut.segments.size() << " segments in " << took.count() << " s\n";
  EXPECT_GT(s.cut.segments.size(), 200U);
  CutOptions apart = s.tree.first_cut;
  apart.objects = false;
  EXPECT_GT(cut(s.tree, apart).segments.size(), 2000U) << "parts that are compared";
  EXPECT_LT(took.count(), 20);

  // The stage that joins parts also checks for a stop in the middle of its work.
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  bool reached = false;
  context.on_progress = [&](const Progress& progress) {
    reached |= progress.stage == "objects";
    if (reached) source.request_stop();
  };
  EXPECT_TRUE(ph::test::fails_with(ErrorKind::cancelled, [&] {
    for (int again = 0; again < 1000; ++again) cut(s.tree, s.tree.first_cut, context);
  })) << "did not stop";
  EXPECT_TRUE(reached);
}

/// A wide box, and in front of it a post that hides its middle.
TableScene box_behind_post() {
  return TableScene(
      {{{-0.15, 0.1, 0}, {0.15, 0.2, 0.12}}, {{-0.02, -0.12, 0}, {0.03, -0.06, 0.3}}});
}

TEST(Objects, PartsOnBothSidesOfAnOccluderAreOne) {
  const TableScene scene = box_behind_post();
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation parts = segment(cloud, {.objects = false});
  EXPECT_EQ(parts.cut.segments.size(), 3U);
  const Segmentation objects = segment(cloud);
  ASSERT_EQ(objects.cut.segments.size(), 2U);
  expect_blocks_apart(scene, objects, 0.95);
}

TEST(Objects, SmallPartsStayByThemselves) {
  const TableScene scene = box_behind_post();
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  const VoxelGrid grid{s.tree.cells, s.tree.vertices, s.tree.counts, {}};
  const Surface surface{s.tree.normals, near_voxels(grid, s.tree.voxel, default_context()),
                        s.tree.viewpoint, s.tree.plane};
  const std::vector<Index> parts =
      s.tree.merge_tree.basins(s.tree.first_cut.value, s.tree.first_cut.min_part);
  EXPECT_NE(join_parts(grid, surface, s.tree.voxel, parts, s.tree.first_cut.min_size), parts);
  EXPECT_EQ(join_parts(grid, surface, s.tree.voxel, parts, s.tree.vertices.rows()), parts);
}

TEST(Objects, BoxesOfDifferentDepthBehindAnOccluderAreTwo) {
  const TableScene scene({{{-0.15, 0.1, 0}, {-0.005, 0.2, 0.12}},
                          {{0.005, 0.16, 0}, {0.15, 0.26, 0.15}},
                          {{-0.04, -0.12, 0}, {0.04, -0.06, 0.3}}});
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}).cut.segments.size(), 3U);
}

}  // namespace
}  // namespace ph::segment
