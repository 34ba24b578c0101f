// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/stages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "libsegment/src/voxels/rips_graph.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/merge_tree.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

TEST(Components, LabelsByDecreasingNumberOfPoints) {
  // Three groups on a line: 1 voxel with 5 points, 3 voxels with 4 points, and 2 voxels with 4
  // points.
  std::vector<float> xyz;
  const auto put = [&](float x, int times) {
    for (int i = 0; i < times; ++i) xyz.insert(xyz.end(), {x, 0.5F, 0.5F});
  };
  put(20.5F, 2), put(0.5F, 5), put(10.5F, 1), put(11.5F, 2), put(12.5F, 1), put(21.5F, 2);
  xyz.insert(xyz.end(), {test::kHole, test::kHole, test::kHole});
  const CloudView cloud{xyz, {}};
  std::vector<Index> points(13);
  std::iota(points.begin(), points.end(), 0);
  const VoxelGrid grid = voxel_grid(cloud, points, 1);
  SceneTree scene;
  scene.xyz.assign(xyz.begin(), xyz.end() - 3);
  scene.vertex_of_point = grid.voxel_of;
  scene.points = points;
  scene.width = 14;
  scene.vertices = grid.centroids;
  scene.counts = grid.counts;
  const std::vector<Index> components =
      merge_tree(rips_graph(grid.centroids, 1, 0)).components(kInfinity);
  const SceneCut found = extract_components(scene, components, 1);
  ASSERT_EQ(found.segments.size(), 3U);
  EXPECT_EQ(found.labels, (std::vector<std::uint32_t>{3, 3, 1, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 0}));
  EXPECT_EQ(found.segments[1].voxels, 3);
  EXPECT_EQ(found.segments[1].points, 4);
  EXPECT_DOUBLE_EQ(found.segments[1].centroid[0], 11.5);
  EXPECT_EQ(found.segments[1].box, (Box{{10.5, 0.5, 0.5}, {12.5, 0.5, 0.5}}));
  EXPECT_TRUE(std::isinf(found.segments[0].persistence));
  EXPECT_EQ(extract_components(scene, components, 2).segments.size(), 2U);
  EXPECT_EQ(extract_components(scene, components, 4).segments.size(), 0U);
}

}  // namespace
}  // namespace ph::segment
