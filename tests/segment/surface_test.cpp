// SPDX-License-Identifier: MIT
// Method surface on small scenes with known answers, and its stages one by one.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <random>

#include "concavity.hpp"
#include "foot.hpp"
#include "objects.hpp"
#include "ph/complex/filtered_graph.hpp"
#include "ph/core/error.hpp"
#include "scenery.hpp"
#include "voxel_pairs.hpp"

namespace ph::segment {
namespace {

using test::kHole;
using test::TableScene;

std::vector<Index> all_of(const std::vector<float>& xyz) {
  std::vector<Index> points(xyz.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<Index>(i);
  return points;
}

/// The share of the points of each block that carry its most frequent label, and that these differ.
void expect_blocks_apart(const TableScene& scene, const Segmentation& s, double share) {
  std::map<int, std::map<std::uint32_t, Index>> labels;
  std::map<int, Index> sizes;
  for (std::size_t i = 0; i < s.labels.size(); ++i) {
    if (scene.truth()[i] <= 0) continue;
    ++labels[scene.truth()[i]][s.labels[i]];
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
  ASSERT_EQ(s.segments.size(), 2U);
  expect_blocks_apart(scene, s, 0.95);
  // They meet in the seam, and each says so.
  EXPECT_EQ(s.segments[0].neighbour, 2U);
  EXPECT_EQ(s.segments[1].neighbour, 1U);
  EXPECT_EQ(s.segments[0].meets_at, s.segments[1].meets_at);
  EXPECT_GT(s.segments[0].meets_at, 0.1);
  EXPECT_GT(s.segments[1].persistence, 0.1);
  EXPECT_LE(s.segments[1].persistence, s.segments[1].meets_at);
  EXPECT_EQ(s.difference, "");
  // By distance alone they are one.
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}, {.method = Method::paper}).segments.size(), 1U);
}

TEST(Surface, AnObjectThatLeansOnAnotherComesApart) {
  const TableScene scene(
      {{{-0.1, 0.05, 0}, {0.1, 0.2, 0.2}}, {{-0.06, -0.1, 0}, {0.05, 0.05, 0.08}}});
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  ASSERT_EQ(s.segments.size(), 2U);
  expect_blocks_apart(scene, s, 0.95);
}

TEST(Surface, TheCutFollowsPersistenceAndSize) {
  const TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation s = segment(cloud);
  const double persistence = s.segments[1].persistence;
  EXPECT_EQ(segment(cloud, {.min_persistence = 1.01 * persistence}).segments.size(), 1U);
  EXPECT_EQ(segment(cloud, {.min_persistence = 0.99 * persistence}).segments.size(), 2U);
  EXPECT_EQ(segment(cloud, {.min_part = s.segments[1].voxels + 50}).segments.size(), 1U);
  // The same from the tree that was stored.
  const std::vector<Index> basins = s.tree.basins(1.01 * persistence, 200);
  EXPECT_EQ(std::ranges::count(basins, basins[0]), static_cast<Index>(basins.size()));
}

TEST(Surface, WhereSegmentsMeetFirst) {
  const TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  const auto meeting = first_meeting(s, 1, 2);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->value, s.segments[0].meets_at);
  const auto& [x, y, z] = meeting->at;  // in the seam, on top of the lower box
  EXPECT_NEAR(s.plane->signed_distance(x, y, z), 0.08, 0.01);
  EXPECT_FALSE(first_meeting(segment(CloudView{TableScene::two_boxes().xyz(), {}}), 1, 2));
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 3}, std::pair{2, 2}})
    EXPECT_THROW(first_meeting(s, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)),
                 Error);
}

TEST(Surface, SeparateObjectsMeetNobody) {
  const Segmentation s = segment(CloudView{TableScene::two_boxes().xyz(), {}});
  ASSERT_EQ(s.segments.size(), 2U);
  for (const Segment& g : s.segments) {
    EXPECT_EQ(g.neighbour, 0U);
    EXPECT_EQ(g.meets_at, kInfinity);
    EXPECT_EQ(g.persistence, kInfinity);
  }
}

TEST(Surface, FeetAreWonBackFromThePlane) {
  std::vector<test::Block> blocks;  // as rows of pixels meet them at several heights
  for (int i = 0; i < 5; ++i) {
    const double x = 0.11 * i - 0.27, y = 0.0011 * i - 0.05;
    blocks.push_back({{x, y, 0}, {x + 0.08, y + 0.08, 0.1}});
  }
  const TableScene scene(blocks);
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  ASSERT_EQ(s.segments.size(), blocks.size());
  expect_blocks_apart(scene, s, 0.95);
  Index within = 0, won = 0, lost = 0;
  for (std::size_t i = 0; i < s.labels.size(); ++i) {
    const float* p = &scene.xyz()[3 * i];
    const double height = s.plane->signed_distance(p[0], p[1], p[2]);
    if (scene.truth()[i] > 0 && height > 0.001 && height <= 0.005) {
      ++within;
      won += s.labels[i] != 0;
    }
    lost += scene.truth()[i] == 0 && s.labels[i] != 0;
  }
  EXPECT_GT(within, 30);
  EXPECT_GT(static_cast<double>(won), 0.9 * static_cast<double>(within));
  EXPECT_EQ(lost, 0);
}

TEST(Surface, CoarseSamplesGetLargerVoxels) {
  const TableScene scene = TableScene::two_boxes();
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}).voxel, 0.005);
  std::vector<float> xyz = scene.xyz();
  for (Index v = 0; v < scene.kHeight; ++v)
    for (Index u = 0; u < scene.kWidth; ++u)
      if (u % 4 != 0 || v % 4 != 0) xyz[3 * static_cast<std::size_t>(v * scene.kWidth + u)] = kHole;
  const Segmentation s = segment(CloudView{xyz, {}});
  EXPECT_GT(s.voxel, 0.005);
  EXPECT_LE(s.voxel, 0.026);
  EXPECT_EQ(s.segments.size(), 2U);
  // Who asks for a size gets it.
  EXPECT_EQ(segment(CloudView{xyz, {}}, {.voxel = 0.005}).voxel, 0.005);
}

/// A strip of 10 x 140 mm, a point a millimetre, seen from 70 cm.
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
    EXPECT_EQ(s.voxel, 0.005);
    ASSERT_EQ(s.segments.size(), 1U);
    EXPECT_EQ(s.segments[0].points, 1400 * times);
  }
  // Points of a plane so far apart that they do not touch are sparse, be they there once or often.
  for (const int times : {1, 5}) {
    std::vector<float> xyz;
    for (int i = 0; i < 40 * 40 * times; ++i)
      xyz.insert(xyz.end(), {0.009F * static_cast<float>(i % 40),
                             0.009F * static_cast<float>(i / 40 % 40), 0.7F});
    const Segmentation s = segment(CloudView{xyz, {}}, {.plane = false});
    EXPECT_GT(s.voxel, 0.005);
    EXPECT_EQ(s.segments.size(), 1U);
    // Each stage once, though the grid was made more often.
    EXPECT_EQ(std::ranges::count(s.stages, "voxel grid", &Stage::name), 1);
    EXPECT_EQ(std::ranges::count(s.stages, "neighbours", &Stage::name), 1);
    EXPECT_EQ(std::ranges::find(s.stages, "voxel grid", &Stage::name)->points, s.vertices.rows());
  }
}

/// Two boxes on a table, scaled, with noise of depth that grows with the square of the range and
/// has this deviation where the middle of the table lies.
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
  // So much noise that the plane is looked for once more; near and far from the sensor.
  const TableScene scene = TableScene::two_boxes();
  for (const double range : {0.3, 2.0}) {
    const Segmentation s =
        segment(CloudView{noisy_boxes(range, 0.004), {}}, {.max_range = 10, .check = false});
    ASSERT_TRUE(s.plane) << range;
    EXPECT_NEAR(s.plane->normal[1], -std::sqrt(0.5), 0.02) << range;
    EXPECT_NEAR(s.plane->offset, range * std::sqrt(0.5), 0.003) << range;
    double table = 0, left_of_table = 0, high = 0, left_of_high = 0;
    for (std::size_t i = 0; i < s.labels.size(); ++i) {
      const bool kept = s.vertex_of_point[i] != SceneTree::kNoVertex;
      const float* p = &scene.xyz()[3 * i];
      const double height = std::sqrt(0.5) * (1 - p[2] - p[1]) * range;  // without the noise
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
  // A sheet of four millimetres on the table, without noise.
  const TableScene scene(std::vector<test::Block>{{{-0.1, -0.1, 0}, {0.1, 0.1, 0.004}}});
  const CloudView cloud{scene.xyz(), {}};
  EXPECT_TRUE(segment(cloud).segments.empty());
  EXPECT_TRUE(segment(cloud, {.plane_distance = 0.01}).segments.empty());
  EXPECT_EQ(segment(cloud, {.plane_distance = 0.002}).segments.size(), 1U);
  EXPECT_EQ(segment(cloud, {.plane_distance = 0.002, .plane_noise = 0}).segments.size(), 1U);
  EXPECT_EQ(segment(cloud, {.plane_distance = 0.003, .plane_noise = 0.002}).segments.size(), 1U);
  EXPECT_TRUE(segment(cloud, {.plane_distance = 0.003, .plane_noise = 0.003}).segments.size() <=
              1U);
}

TEST(Surface, NoiseThatGrowsWithTheRangeLeavesTheTableEmpty) {
  // As of a sensor by disparity: a deviation of 1.4 mm at one metre.
  TableScene scene = TableScene::two_boxes();
  std::vector<float> xyz = scene.xyz();
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.0014);
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double z = xyz[i + 2], factor = 1 + noise(random) * z;
    for (std::size_t k = 0; k < 3; ++k) xyz[i + k] = static_cast<float>(factor * xyz[i + k]);
  }
  const Segmentation s = segment(CloudView{xyz, {}});
  EXPECT_EQ(s.segments.size(), 2U);
  expect_blocks_apart(scene, s, 0.9);
}

TEST(Surface, HalfABallIsOne) {
  std::vector<float> xyz;  // half a ball of 8 cm, seen from the origin
  constexpr int steps = 120;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const double a = std::numbers::pi * i / steps, b = std::numbers::pi * k / steps;
      xyz.push_back(static_cast<float>(0.08 * std::cos(a)));
      xyz.push_back(static_cast<float>(0.08 * std::sin(a) * std::cos(b)));
      xyz.push_back(static_cast<float>(0.8 - 0.08 * std::sin(a) * std::sin(b)));
    }
  }
  EXPECT_EQ(segment(CloudView{xyz, {}}, {.plane = false}).segments.size(), 1U);
}

/// Specks of nine voxels and spaces between them, in front of a wall of specks that they hide here
/// and there: as many parts as there are.
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
  std::cout << s.segments.size() << " segments in " << took.count() << " s\n";
  EXPECT_GT(s.segments.size(), 200U);
  CutOptions apart = s.first_cut;
  apart.objects = false;
  EXPECT_GT(cut(s, apart).segments.size(), 2000U) << "parts that are compared";
  EXPECT_LT(took.count(), 20);

  // The joins ask, too: a stop that is requested in the middle of them is seen.
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  bool reached = false;
  context.on_progress = [&](const Progress& progress) {
    reached |= progress.stage == "objects";
    if (reached) source.request_stop();
  };
  try {
    for (int again = 0; again < 1000; ++again) cut(s, s.first_cut, context);
    ADD_FAILURE() << "did not stop";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cancelled);
  }
  EXPECT_TRUE(reached);
}

/// A wide box and in front of it a post that hides its middle.
TableScene box_behind_post() {
  return TableScene(
      {{{-0.15, 0.1, 0}, {0.15, 0.2, 0.12}}, {{-0.02, -0.12, 0}, {0.03, -0.06, 0.3}}});
}

TEST(Objects, PartsOnBothSidesOfAnOccluderAreOne) {
  const TableScene scene = box_behind_post();
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation parts = segment(cloud, {.objects = false});
  EXPECT_EQ(parts.segments.size(), 3U);
  const Segmentation objects = segment(cloud);
  ASSERT_EQ(objects.segments.size(), 2U);
  expect_blocks_apart(scene, objects, 0.95);
}

TEST(Objects, BoxesOfDifferentDepthBehindAnOccluderAreTwo) {
  const TableScene scene({{{-0.15, 0.1, 0}, {-0.005, 0.2, 0.12}},
                          {{0.005, 0.16, 0}, {0.15, 0.26, 0.15}},
                          {{-0.04, -0.12, 0}, {0.04, -0.06, 0.3}}});
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}).segments.size(), 3U);
}

TEST(VoxelPairs, AreAllThatAreClose) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-0.04F, 0.05F);
  for (const double radius : {0.3, 1.0, 2.4, 3.0}) {
    std::vector<float> xyz(3 * 1500);
    for (float& c : xyz) c = coordinate(random);
    constexpr double voxel = 0.006;
    const VoxelGrid grid = voxel_grid({xyz, {}}, all_of(xyz), voxel);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> expected;
    for (Index v = 0; v < grid.centroids.rows(); ++v)
      for (Index u = 0; u < v; ++u) {
        const double d = (grid.centroids.row(u) - grid.centroids.row(v)).norm();
        if (d < radius * voxel) expected[{u, v}] = d;
      }
    const VoxelPairs pairs = close_voxels(grid, voxel, radius);
    EXPECT_EQ(pairs.size(), expected.size());
    for (const VoxelPair& p : pairs) {
      const auto it = expected.find({p.u, p.v});
      ASSERT_NE(it, expected.end());
      EXPECT_FLOAT_EQ(p.distance, static_cast<float>(it->second));
    }
  }
}

TEST(VoxelPairs, FarAwayThereAreNoneAndAnError) {
  const auto refuses = [](const VoxelGrid& grid) {
    try {
      close_voxels(grid, 0.005, 3);
    } catch (const Error& error) {
      return error.kind() == ErrorKind::usage;
    }
    return false;
  };
  for (const std::size_t axis : {0U, 1U, 2U}) {
    for (const double sign : {-1.0, 1.0}) {
      VoxelGrid grid{std::vector<Vec3>(1), Points::Zero(1, 3), {1}, {0}};
      grid.cells[0][axis] = sign * 0x1p52;
      EXPECT_EQ(close_voxels(grid, 0.005, 3).size(), 0U);
      grid.cells[0][axis] = sign * 0x1p53;
      EXPECT_TRUE(refuses(grid)) << axis << ' ' << sign;
    }
  }
}

/// The kind of the error that segmenting one point with these options is, if any.
std::optional<ErrorKind> failure(const std::vector<float>& xyz, const Vec3& viewpoint,
                                 const SegmentOptions& options) {
  try {
    segment(CloudView{xyz, viewpoint}, options);
  } catch (const Error& error) {
    return error.kind();
  }
  return std::nullopt;
}

TEST(VoxelPairs, EveryWayToVoxelsWithoutNeighboursIsRefused) {
  for (const Method method : {Method::surface, Method::supervoxels}) {
    const auto far = static_cast<float>(0x1p70);
    EXPECT_EQ(failure({0, 0, far}, {0, 0, far}, {.method = method}), ErrorKind::usage);
    EXPECT_EQ(failure({0, 1e20F, 0}, {}, {.method = method, .max_range = kInfinity}),
              ErrorKind::usage);
    EXPECT_EQ(failure({0, 0, 1}, {}, {.method = method, .voxel = 1e-17}), ErrorKind::usage);
  }
  EXPECT_EQ(failure({0, 0, 1}, {}, {.method = Method::paper, .voxel = 1e-17}), std::nullopt);
}

TEST(VoxelPairs, HugeVoxelsAreRefusedOrHoldAll) {
  const std::vector<float> xyz = {0, 0, 1, 3e38F, 0, 1, -3e38F, 0, 1};
  for (const Method method : {Method::surface, Method::paper, Method::supervoxels}) {
    for (const double voxel : {6e307, 1e308, 1e-300, 1.1e30})
      EXPECT_EQ(failure(xyz, {}, {.method = method, .voxel = voxel}), ErrorKind::usage) << voxel;
    SegmentOptions huge{.method = method, .voxel = 1e30, .min_size = 1, .max_range = kInfinity};
    huge.spacing = 1e30;
    EXPECT_EQ(segment(CloudView{xyz, {}}, huge).vertices.rows(), 3);
    huge.max_range = 2;
    EXPECT_EQ(segment(CloudView{xyz, {}}, huge).vertices.rows(), 1);
  }
}

/// Two half planes that meet in the line y = z = 0 and rise by an angle on both sides of it, as
/// seen from high above.
Points valley(double angle, double step) {
  std::vector<Vec3> points;
  for (double x = -0.05; x < 0.05; x += step) {
    for (double t = -0.05; t < 0.05; t += step)
      points.push_back({x, t * std::cos(angle), std::abs(t) * std::sin(angle)});
  }
  Points result(static_cast<Index>(points.size()), 3);
  for (Index i = 0; i < result.rows(); ++i)
    for (Index k = 0; k < 3; ++k)
      result(i, k) = points[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  return result;
}

std::vector<VoxelPair> pairs_within(const Points& points, double radius) {
  std::vector<VoxelPair> pairs;
  for (std::uint32_t v = 0; v < points.rows(); ++v)
    for (std::uint32_t u = 0; u < v; ++u)
      if (const double d = (points.row(u) - points.row(v)).norm(); d < radius)
        pairs.push_back({u, v, static_cast<float>(d)});
  return pairs;
}

TEST(Normals, AreTheDirectionsOfLeastSpread) {
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  for (int round = 0; round < 2000; ++round) {
    // From a ball to a needle of 10 mm by 10 um, in a random position. far from the origin or not.
    const Eigen::Vector3d sizes(1, std::pow(10, -1.0 * (round % 4)),
                                std::pow(10, -1.0 * (round % 7)));
    const Eigen::Matrix3d turn = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    Points points(3 + round % 20, 3);
    for (Index i = 0; i < points.rows(); ++i) {
      const Eigen::Vector3d p(gauss(random), gauss(random), gauss(random));
      points.row(i) = (0.01 * (turn * (sizes.array() * p.array()).matrix())).transpose();
    }
    const Eigen::RowVector3d mean = points.colwise().mean();
    const Eigen::Matrix3d scatter =
        (points.rowwise() - mean).transpose() * (points.rowwise() - mean);
    std::vector<VoxelPair> pairs;
    for (std::uint32_t v = 1; v < points.rows(); ++v)
      pairs.push_back({0, v, static_cast<float>((points.row(v) - points.row(0)).norm())});
    const Points normals = surface_normals(points, pairs, 1, {0, 0, 10});
    const Eigen::Vector3d n = normals.row(0).transpose();
    ASSERT_NEAR(n.norm(), 1, 1e-12);
    // A direction may be any of many; how little spreads along it may not.
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()[0];
    ASSERT_NEAR(n.dot(scatter * n), least, 1e-9 * scatter.trace()) << sizes.transpose();
  }
}

TEST(Concavity, IsLargeInValleysAndZeroOnRidges) {
  for (const double angle : {-0.6, 0.0, 0.3, 0.6}) {
    const Points points = valley(angle, 0.005);
    const auto pairs = pairs_within(points, 0.015);
    const Points normals = surface_normals(points, pairs, 0.012, {0, 0, 10});
    const std::vector<double> f = concavity(points, normals, pairs);
    double seam = 0, flat = 0;
    for (Index v = 0; v < points.rows(); ++v) {
      EXPECT_NEAR(normals.row(v).norm(), 1, 1e-9);
      EXPECT_GT(normals(v, 2), 0);
      const double value = f[static_cast<std::size_t>(v)];
      EXPECT_GE(value, 0);
      if (std::abs(points(v, 1)) < 0.004) seam = std::max(seam, value);
      if (std::abs(points(v, 1)) > 0.03) flat = std::max(flat, value);
    }
    EXPECT_LT(flat, 1e-9);
    if (angle <= 0)
      EXPECT_LT(seam, 1e-9);
    else
      EXPECT_GT(seam, 0.5 * std::sin(angle));
  }
}

TEST(Objects, PartsJoinOverARidgeAndNotInAValley) {
  for (const double angle : {-0.6, 0.6}) {
    VoxelGrid grid;
    grid.centroids = valley(angle, 0.005);
    Surface surface;
    const std::vector<VoxelPair> pairs = pairs_within(grid.centroids, 0.015);
    surface.pairs.assign(pairs.begin(), pairs.end());
    surface.normals = surface_normals(grid.centroids, surface.pairs, 0.012, {0, 0, 10});
    std::vector<Index> part_of;
    std::array<Index, 2> first = {-1, -1};
    for (Index v = 0; v < grid.centroids.rows(); ++v) {
      Index& part = first[grid.centroids(v, 1) < 0 ? 0 : 1];
      if (part < 0) part = v;
      part_of.push_back(part);
    }
    const std::vector<Index> objects = join_parts(grid, surface, 0.005, part_of, 32);
    EXPECT_EQ(std::ranges::count(objects, objects[0]),
              angle < 0 ? std::ssize(part_of) : std::ranges::count(part_of, part_of[0]))
        << angle;
    // Small parts stay by themselves.
    EXPECT_EQ(join_parts(grid, surface, 0.005, part_of, 1000), part_of);
  }
}

TEST(Concavity, FewNeighboursHaveNoNormalAndNoValue) {
  Points points(2, 3);
  points << 0, 0, 1, 0, 0.01, 1;
  const auto pairs = pairs_within(points, 0.02);
  const Points normals = surface_normals(points, pairs, 0.02, {});
  EXPECT_TRUE(std::isnan(normals(0, 0)));
  EXPECT_EQ(concavity(points, normals, pairs), (std::vector<double>{0, 0}));
}

TEST(MergeTree, BasinsAreWhatTheCutLeaves) {
  // A path with the values 0 5 1 9 2 3: minima 0, 1, 2; the merges at 5 and 9.
  const std::vector<double> values = {0, 5, 1, 9, 2, 3};
  std::vector<WeightedEdge> edges;
  for (Index v = 1; v < 6; ++v) edges.push_back({v - 1, v, 0.0});
  const MergeTree tree = merge_tree(FilteredGraph::lower_star(values, edges));
  const auto sizes = [&](double persistence, Index size) {
    std::map<Index, Index> count;
    for (const Index b : tree.basins(persistence, size)) ++count[b];
    std::vector<Index> result;
    for (const auto& [basin, n] : count) result.push_back(n);
    std::ranges::sort(result);
    return result;
  };
  EXPECT_EQ(sizes(1, 1), (std::vector<Index>{2, 2, 2}));
  EXPECT_EQ(sizes(5, 1), (std::vector<Index>{2, 4}));  // the merge at 5 has persistence 4
  EXPECT_EQ(sizes(8, 1), (std::vector<Index>{6}));
  EXPECT_EQ(sizes(1, 2), (std::vector<Index>{2, 4}));  // and a component of one vertex
}

}  // namespace
}  // namespace ph::segment
