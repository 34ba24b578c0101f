// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scenery.hpp"
#include "spacing.hpp"

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
  EXPECT_GT(pieces.segments.size(), 5 * objects.segments.size());
  std::map<std::uint32_t, std::set<std::uint32_t>> objects_of;
  for (std::size_t i = 0; i < pieces.labels.size(); ++i) {
    if (objects.labels[i] == 0) continue;
    ASSERT_NE(pieces.labels[i], 0U);
    objects_of[pieces.labels[i]].insert(objects.labels[i]);
  }
  for (const auto& [piece, found] : objects_of) EXPECT_EQ(found.size(), 1U) << piece;
}

TEST(Supervoxels, AreNoLargerThanTheSpacingAllowsAndFewerWhereItIsLarge) {
  const TableScene scene = TableScene::two_boxes();
  const CloudView cloud{scene.xyz(), {}};
  std::size_t before = SIZE_MAX;
  for (const double spacing : {0.02, 0.03, 0.05}) {
    const Segmentation s = segment(cloud, spaced(spacing));
    EXPECT_LT(s.segments.size(), before);
    before = s.segments.size();
    for (const Segment& piece : s.segments)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT(piece.box.max[k] - piece.box.min[k], 4 * spacing) << piece.label;
  }
}

TEST(Supervoxels, ACoarserCutJoinsWholeOnes) {
  const TableScene scene = TableScene::two_boxes();
  const CloudView cloud{scene.xyz(), {}};
  const Segmentation fine = segment(cloud, spaced(0.02));
  CutOptions options = fine.first_cut;
  options.value = 0.02;
  const SceneCut coarse = cut(fine, options);
  EXPECT_LT(coarse.segments.size(), fine.segments.size());
  std::map<std::uint32_t, std::uint32_t> whole;
  for (std::size_t v = 0; v < fine.vertex_labels.size(); ++v)
    EXPECT_EQ(whole.try_emplace(fine.vertex_labels[v], coarse.vertex_labels[v]).first->second,
              coarse.vertex_labels[v]);
}

TEST(Spacing, DistancesAreThoseAlongTheGraph) {
  // A path of 21 voxels, 1 cm apart, with a seam in the middle of its right half.
  const Index size = 21;
  Points points = Points::Zero(size, 3);
  std::vector<WeightedEdge> edges;
  for (Index i = 0; i < size; ++i) {
    points(i, 0) = 0.01 * static_cast<double>(i);
    if (i > 0) edges.push_back({i, i - 1, 0.01});
  }
  std::vector<double> concavity(static_cast<std::size_t>(size));
  // The seeds: 0, then 20, the farthest one; all others are at most 10 cm from one of them.
  std::vector<double> f = distance_to_seeds(points, edges, concavity, 0.1, default_context());
  for (Index i = 0; i < size; ++i)
    EXPECT_NEAR(f[static_cast<std::size_t>(i)], 0.01 * static_cast<double>(std::min(i, 20 - i)),
                1e-12);
  concavity[15] = 0.25;  // two steps lead there, each costs eleven times its length
  f = distance_to_seeds(points, edges, concavity, 0.1, default_context());
  EXPECT_NEAR(f[16], 0.04, 1e-12);
  EXPECT_NEAR(f[15], 0.15, 1e-12);  // from the seed on the right
  EXPECT_NEAR(f[14], 0.14, 1e-12);  // from the left
  // A piece without a seed of its own gets one.
  edges.erase(edges.begin() + 4);
  edges.erase(edges.begin() + 8);
  f = distance_to_seeds(points, edges, concavity, 0.1, default_context());
  EXPECT_TRUE(std::ranges::all_of(f, [](double x) { return std::isfinite(x); }));
  EXPECT_EQ(f[5], 0);
}

}  // namespace
}  // namespace ph::segment
