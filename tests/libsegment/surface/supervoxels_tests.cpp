// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <random>
#include <set>

#include "libsegment/src/surface/seeds.hpp"
#include "ph/error.hpp"
#include "ph/greedy_permutation.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using test::TableScene;

SegmentOptions spaced(double spacing) {
  return {.method = Method::supervoxels, .spacing = spacing};
}

TEST(Supervoxels, CoverWhatStandsOnTheTable) {
  const TableScene scene = TableScene::two_boxes();
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation objects = segment(cloud), pieces = segment(cloud, spaced(0.03));
  EXPECT_EQ(pieces.difference, "");
  EXPECT_GT(pieces.cut.segments.size(), 5 * objects.cut.segments.size());
  std::map<std::uint32_t, std::set<std::uint32_t>> objects_of;
  for (std::size_t i = 0; i < pieces.cut.labels.size(); ++i) {
    if (objects.cut.labels[i] == 0) continue;
    ASSERT_NE(pieces.cut.labels[i], 0U);
    objects_of[pieces.cut.labels[i]].insert(objects.cut.labels[i]);
  }
  for (const auto& [piece, found] : objects_of) EXPECT_EQ(found.size(), 1U) << piece;
}

TEST(Supervoxels, AreNoLargerThanTheSpacingAllowsAndFewerWhereItIsLarge) {
  const TableScene scene = TableScene::two_boxes();
  const CloudView cloud{scene.xyz(), {}};
  std::size_t before = SIZE_MAX;
  for (const double spacing : {0.02, 0.03, 0.05}) {
    const Segmentation s = segment(cloud, spaced(spacing));
    EXPECT_LT(s.cut.segments.size(), before);
    before = s.cut.segments.size();
    for (const Segment& piece : s.cut.segments)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT(piece.box.max[k] - piece.box.min[k], 4 * spacing) << piece.label;
  }
}

TEST(Supervoxels, ACoarserCutJoinsWholeOnes) {
  const TableScene scene = TableScene::two_boxes();
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation fine = segment(cloud, spaced(0.02));
  CutOptions options = fine.tree.first_cut;
  options.value = 0.02;
  const SceneCut coarse = cut(fine.tree, options);
  EXPECT_LT(coarse.segments.size(), fine.cut.segments.size());
  std::map<std::uint32_t, std::uint32_t> whole;
  for (std::size_t v = 0; v < fine.cut.vertex_labels.size(); ++v)
    EXPECT_EQ(whole.try_emplace(fine.cut.vertex_labels[v], coarse.vertex_labels[v]).first->second,
              coarse.vertex_labels[v]);
}

TEST(Supervoxels, SeedsAsDenseAsVoxelsTakeBoundedTime) {
  std::vector<float> xyz;  // 60 000 voxels of 5 mm
  for (int i = 0; i < 490; ++i)
    for (int k = 0; k < 490; ++k)
      xyz.insert(xyz.end(),
                 {0.0025F * static_cast<float>(i), 0.0025F * static_cast<float>(k), 1.0F});
  const auto start = std::chrono::steady_clock::now();
  SegmentOptions o = spaced(0.005);
  o.plane = o.check = false;
  const Segmentation s = segment(CloudView{xyz, {}}, o);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::cout << s.tree.vertices.rows() << " voxels in " << took.count() << " s\n";
  EXPECT_GT(s.tree.vertices.rows(), 50000);
  EXPECT_LT(took.count(), 20);
  o.spacing = 0.0049;
  EXPECT_THROW(segment(CloudView{xyz, {}}, o), Error);
}

TEST(Spacing, SeedsAreThoseOfAGreedyPermutation) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  for (const double spacing : {0.02, 0.1, 0.3, 2.0}) {
    Points points(1500, 3);
    for (Index i = 0; i < points.rows(); ++i)
      points.set_row(i, {place(random), place(random), 0.1 * place(random)});
    GreedyLimits limits;
    limits.radius = spacing;
    const auto expected = greedy_permutation(points, limits, PointDistance::euclidean, 2);
    std::vector<WeightedEdge> edges;  // a path: only seeds are at distance 0 from a seed
    for (Index i = 1; i < points.rows(); ++i) edges.push_back({i, i - 1, 1.0});
    const std::vector<double> f =
        distance_to_seeds(points, edges, std::vector<double>(1500), spacing, default_context());
    for (std::uint32_t i = 0; i < 1500; ++i)
      EXPECT_EQ(f[i] == 0, std::ranges::count(expected.points, i) == 1) << i;
  }
}

TEST(Spacing, DistancesAreThoseAlongTheGraph) {
  // A path of 21 voxels, 1 cm apart, with a concave seam in the middle of its right half.
  const Index size = 21;
  Points points(size, 3);
  std::vector<WeightedEdge> edges;
  for (Index i = 0; i < size; ++i) {
    points(i, 0) = 0.01 * static_cast<double>(i);
    if (i > 0) edges.push_back({i, i - 1, 0.01});
  }
  std::vector<double> concavity(static_cast<std::size_t>(size));
  // The seeds are 0 and then 20, the farthest voxel. All other voxels are at most 10 cm from a
  // seed.
  std::vector<double> f = distance_to_seeds(points, edges, concavity, 0.1, default_context());
  for (Index i = 0; i < size; ++i)
    EXPECT_NEAR(f[static_cast<std::size_t>(i)], 0.01 * static_cast<double>(std::min(i, 20 - i)),
                1e-12);
  concavity[15] = 0.25;  // two steps reach this voxel, and each costs eleven times its length
  f = distance_to_seeds(points, edges, concavity, 0.1, default_context());
  EXPECT_NEAR(f[16], 0.04, 1e-12);
  EXPECT_NEAR(f[15], 0.15, 1e-12);  // from the right seed
  EXPECT_NEAR(f[14], 0.14, 1e-12);  // from the left seed
  // A component without a seed gets a seed of its own.
  edges.erase(edges.begin() + 4);
  edges.erase(edges.begin() + 8);
  f = distance_to_seeds(points, edges, concavity, 0.1, default_context());
  EXPECT_TRUE(std::ranges::all_of(f, [](double x) { return std::isfinite(x); }));
  EXPECT_EQ(f[5], 0);
}

}  // namespace
}  // namespace ph::segment
