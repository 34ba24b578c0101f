// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/libsegment/scenery.hpp"
#include "tests/libsegment/vessel_scene.hpp"

namespace ph::segment {
namespace {

using test::Met;
using test::Vessel;
using test::VesselScene;

constexpr Plane kTable{{0, 0, 1}, 0, 1};
constexpr double kVoxel = 0.005, kMargin = 0.005;

/// The points that are restored through the openings of objects in a scene.
struct Found {
  std::vector<Index> points;        ///< the restored points
  std::vector<std::uint32_t> to;    ///< the voxel that each restored point joined
  Points centroids;                 ///< the centroids of all voxels
  std::map<Met, std::size_t> what;  ///< for each kind of thing, the number of restored points
};

/// @param object_of returns the object at a position (x, y) of a voxel. Every voxel above the table
/// has an object.
template <class ObjectOf>
Found find(const VesselScene& scene, const Vec3& eye, ObjectOf&& object_of) {
  const CloudView cloud{scene.xyz(), eye};
  const std::vector<Index> in_range = test::all_of(scene.xyz());
  std::vector<Index> points;
  for (const Index i : in_range)
    if (cloud.point(static_cast<std::size_t>(i))[2] > kMargin) points.push_back(i);
  const std::size_t beyond = points.size();
  VoxelGrid grid = voxel_grid(cloud, points, kVoxel);
  std::map<int, Index> example;
  std::vector<Index> objects;
  for (Index v = 0; v < grid.centroids.rows(); ++v)
    objects.push_back(example.try_emplace(object_of(grid.centroids(v, 0), grid.centroids(v, 1)), v)
                          .first->second);
  assign_points_in_openings(cloud, in_range, kTable, kVoxel, objects, 32, points, grid);
  Found found;
  found.points.assign(points.begin() + static_cast<std::ptrdiff_t>(beyond), points.end());
  EXPECT_EQ(grid.voxel_of.size(), points.size());
  found.to.assign(grid.voxel_of.begin() + static_cast<std::ptrdiff_t>(beyond), grid.voxel_of.end());
  found.centroids = grid.centroids;
  for (const Index i : found.points) ++found.what[scene.met()[static_cast<std::size_t>(i)]];
  return found;
}

Found find(const VesselScene& scene) {  // everything is one object
  return find(scene, scene.eye(), [](double, double) { return 0; });
}

TEST(Openings, ShowTheBottomsOfVessels) {
  for (const double radius : {0.03, 0.05, 0.08, 0.15, 0.23}) {
    for (const double depth : {0.0, 0.03}) {
      const VesselScene scene(Vessel{.radius = radius, .height = 0.8 * radius}, depth);
      Found found = find(scene);
      EXPECT_GT(scene.count(Met::bottom), 30U);
      EXPECT_GT(found.what[Met::bottom], 0.9 * static_cast<double>(scene.count(Met::bottom)));
      // The other points are at the foot of the rear wall. No point of the table in front of the
      // vessel or beside it is included.
      EXPECT_EQ(found.what[Met::bottom] + found.what[Met::inside], found.points.size());
      EXPECT_TRUE(std::ranges::is_sorted(found.points));
      EXPECT_EQ(std::set(found.to.begin(), found.to.end()).size(), 1U);
      EXPECT_LT(found.centroids(found.to[0], 2), 2 * kVoxel);
    }
  }
}

TEST(Openings, ShowNothingFarBelowTheTable) {
  const VesselScene scene(Vessel{}, 0.06);
  EXPECT_GT(scene.count(Met::bottom), 100U);
  EXPECT_EQ(find(scene).what[Met::bottom], 0U);
}

TEST(Openings, EachVesselHasItsOwn) {
  const VesselScene scene(
      {{.x = -0.2, .y = 0.05, .radius = 0.06}, {.x = 0.2, .y = -0.1, .radius = 0.1}});
  Found found = find(scene, scene.eye(), [](double x, double) { return x < 0 ? 0 : 1; });
  EXPECT_GT(found.what[Met::bottom], 0.9 * static_cast<double>(scene.count(Met::bottom)));
  std::set<std::uint32_t> voxels;
  for (std::size_t k = 0; k < found.points.size(); ++k) {
    const float x = scene.xyz()[3 * static_cast<std::size_t>(found.points[k])];
    EXPECT_EQ(x < 0, found.centroids(found.to[k], 0) < 0);
    voxels.insert(found.to[k]);
  }
  EXPECT_EQ(voxels.size(), 2U);
  // If the two vessels are one object, this object has no round rim.
  EXPECT_TRUE(find(scene).points.empty());
}

TEST(Openings, ARimMayHaveAHandle) {
  for (const double length : {0.03, 0.06, 0.08}) {
    VesselScene scene(Vessel{.radius = 0.08});
    for (double x = 0.08; x < 0.08 + length; x += 0.001)
      for (double y = -0.006; y < 0.006; y += 0.001) scene.add(x, y, 0.058, Met::outside);
    Found found = find(scene);
    EXPECT_GT(found.what[Met::bottom], 0.9 * static_cast<double>(scene.count(Met::bottom)))
        << length;
    EXPECT_EQ(found.what[Met::table], 0U);
  }
}

TEST(Openings, AreRoundOnMostOfTheCircle) {
  for (const double part : {100.0, 170.0, 250.0}) {  // the gap is on the right
    const VesselScene scene(Vessel{.from = 180 - part / 2, .to = 180 + part / 2});
    EXPECT_EQ(find(scene).points.empty(), part < 200) << part;
  }
  for (const double middle : {0.0, 90.0, 180.0, 270.0}) {
    const VesselScene sheet(Vessel{.from = middle - 50, .to = middle + 50});
    EXPECT_TRUE(find(sheet).points.empty()) << middle;
  }
}

TEST(Openings, ShowNothingBehindAGapInTheWall) {
  for (const double depth : {0.0, 0.03}) {
    const VesselScene scene(Vessel{.from = 145, .to = 395}, depth);  // open at the back
    Found found = find(scene);
    EXPECT_GT(found.what[Met::bottom], 0.9 * static_cast<double>(scene.count(Met::bottom)));
    EXPECT_EQ(found.what[Met::table], 0U);
  }
}

TEST(Openings, HaveNoLid) {
  const VesselScene full(Vessel{.has_lid = true});
  EXPECT_GT(full.count(Met::lid), 500U);
  EXPECT_TRUE(find(full).points.empty());
  VesselScene with_a_spoon(Vessel{});
  for (double x = -0.03; x < 0.03; x += 0.0005)
    for (double y = -0.005; y < 0.005; y += 0.0005) with_a_spoon.add(x, y, 0.055, Met::lid);
  EXPECT_FALSE(find(with_a_spoon).points.empty());
}

TEST(Openings, AreNotAsSmallAsAScrew) {
  EXPECT_TRUE(find(VesselScene(Vessel{.radius = 0.015})).points.empty());
  EXPECT_FALSE(find(VesselScene(Vessel{.radius = 0.28})).points.empty()) << "a large bowl";
}

TEST(Openings, OfAnObjectThatIsTooSmallAreNone) {
  const VesselScene scene(Vessel{});
  EXPECT_FALSE(find(scene).points.empty());
  int next = 0;  // each voxel is an object
  EXPECT_TRUE(find(scene, scene.eye(), [&](double, double) { return ++next; }).points.empty());
}

TEST(Openings, AreSeenFromAbove) {
  const VesselScene scene(Vessel{});
  EXPECT_TRUE(find(scene, {0, -1, 0.05}, [](double, double) { return 0; }).points.empty());
}

TEST(Openings, BoxesHaveNone) {
  const test::TableScene scene = test::TableScene::two_boxes();
  SegmentOptions options;
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, options);
  EXPECT_EQ(s.cut.segments.size(), 2U);
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i)
    ASSERT_FALSE(s.cut.labels[i] != 0 && scene.truth()[i] == 0);
}

// ---- in a whole scene

TEST(OpeningsOfScenes, BottomsHaveTheLabelOfTheirVessel) {
  for (const double depth : {0.0, 0.03}) {
    const VesselScene scene({{.x = -0.15}, {.x = 0.15, .radius = 0.06, .height = 0.05}}, depth);
    const Segmentation s = segment(scene.cloud(), {});
    ASSERT_EQ(s.cut.segments.size(), 2U);
    std::size_t right = 0, wrong = 0;
    for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
      if (scene.met()[i] == Met::table) {
        // Some points of the table at the foot of a wall may get the label of the wall.
        wrong += s.cut.labels[i] != 0 && scene.xyz()[3 * i + 2] < 0.001 ? 1 : 0;
      } else if (scene.met()[i] == Met::bottom) {
        right += s.cut.labels[i] == (scene.xyz()[3 * i] < 0 ? 1U : 2U) ? 1 : 0;
      }
    }
    EXPECT_GT(right, 0.9 * static_cast<double>(scene.count(Met::bottom)));
    EXPECT_EQ(wrong, 0U);
  }
}

TEST(OpeningsOfScenes, OnlyMethodSurfaceLooksThroughThem) {
  const VesselScene scene(Vessel{});
  for (const Method method : {Method::paper, Method::supervoxels}) {
    const Segmentation s = segment(scene.cloud(), {.method = method, .check = false});
    for (std::size_t i = 0; i < s.cut.labels.size(); ++i)
      ASSERT_FALSE(s.cut.labels[i] != 0 && scene.met()[i] == Met::bottom);
  }
}

}  // namespace
}  // namespace ph::segment
