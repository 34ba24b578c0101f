// SPDX-License-Identifier: MIT
#include "ph/label_tracker.hpp"

#include <gtest/gtest.h>

#include "libsegment/scenery.hpp"
#include "ph/segment.hpp"

namespace ph::segment {
namespace {

using Labels = std::vector<std::uint32_t>;

TEST(LabelTracker, AnObjectKeepsItsNumber) {
  LabelTracker tracker;
  EXPECT_EQ(tracker.update(Labels{1, 1, 1, 0, 2, 2}), (Labels{1, 1, 1, 0, 2, 2}));
  // The order of size changes, the numbers do not.
  EXPECT_EQ(tracker.update(Labels{2, 2, 0, 1, 1, 1}), (Labels{1, 1, 0, 2, 2, 2}));
  // A new one is 3, although it is the largest.
  EXPECT_EQ(tracker.update(Labels{3, 1, 1, 1, 2, 2}), (Labels{1, 3, 3, 3, 2, 2}));
  EXPECT_EQ(tracker.update(Labels{0, 0, 0, 0, 0, 0}), (Labels{0, 0, 0, 0, 0, 0}));
}

TEST(LabelTracker, NoObjectIsTakenTwice) {
  LabelTracker tracker;
  tracker.update(Labels{1, 1, 1, 1, 1, 1});
  // It comes apart: the larger part keeps the number.
  EXPECT_EQ(tracker.update(Labels{2, 2, 1, 1, 1, 1}), (Labels{2, 2, 1, 1, 1, 1}));
  // They become one again: it has the number with which it shares more.
  EXPECT_EQ(tracker.update(Labels{7, 7, 7, 7, 7, 7}), (Labels{1, 1, 1, 1, 1, 1}));
}

TEST(LabelTracker, LittleOverlapIsNone) {
  LabelTracker tracker;
  tracker.update(Labels{1, 1, 1, 1, 0, 0, 0});
  EXPECT_EQ(tracker.update(Labels{0, 0, 0, 1, 1, 1, 1}), (Labels{0, 0, 0, 2, 2, 2, 2}));
  EXPECT_EQ(tracker.update(Labels{0, 0, 0, 1, 1, 1}), (Labels{0, 0, 0, 3, 3, 3}))
      << "another raster";
}

TEST(LabelTracker, RemembersForSomeFrames) {
  LabelTracker tracker(2);
  const Labels both = {1, 1, 1, 2, 2}, one = {1, 1, 1, 0, 0};
  EXPECT_EQ(tracker.update(both), both);
  tracker.update(one), tracker.update(one);
  EXPECT_EQ(tracker.update(both), both);
  for (int i = 0; i < 3; ++i) tracker.update(one);
  EXPECT_EQ(tracker.update(both), (Labels{1, 1, 1, 3, 3})) << "forgotten";
}

TEST(LabelTracker, LabelsAreNumbersAsTheyLike) {
  LabelTracker tracker;
  const Labels far = {UINT32_MAX, UINT32_MAX, 0, 5, 5, 5};
  EXPECT_EQ(tracker.update(far), (Labels{2, 2, 0, 1, 1, 1}));
  EXPECT_EQ(tracker.update(Labels{1, 1, 0, 2, 2, 2}), (Labels{2, 2, 0, 1, 1, 1}));
}

TEST(LabelTracker, VoxelsOfAnotherSizeShowTheSameObjects) {
  const Cloud cloud = test::TableScene::two_boxes().cloud();
  LabelTracker tracker;
  std::size_t frame = 0;
  for (const double voxel : {0.005, 0.0075, 0.01125, 0.006, 0.005}) {
    Segmentation s = segment(cloud, {.voxel = voxel, .min_part = 30});
    s.width *= s.height, s.height = 1;
    ASSERT_EQ(s.segments.size(), 2U);
    EXPECT_EQ(tracker.update(s, s), (Labels{1, 2})) << frame++;
  }
}

TEST(LabelTracker, AMovingScene) {
  LabelTracker pixels, voxels;
  for (int frame = 0; frame < 6; ++frame) {
    const double x = 0.01 * frame;
    // The right box grows past the left one: labels by size change places.
    const double more = 0.02 * frame;
    const test::TableScene scene({{{-0.22 + x, -0.05, 0}, {-0.10 + x, 0.07, 0.12}},
                                  {{0.10, -0.05, 0}, {0.2 + more, 0.05, 0.1}}});
    const Cloud cloud = scene.cloud();
    Segmentation s = segment(cloud);
    ASSERT_EQ(s.segments.size(), 2U);
    const bool right_first = s.segments[0].centroid[0] > 0;
    const Labels expected = right_first ? Labels{2, 1} : Labels{1, 2};
    EXPECT_EQ(pixels.update(s, s), expected) << frame;
    s.width *= s.height, s.height = 1;  // as if it were not organised
    EXPECT_EQ(voxels.update(s, s), expected) << frame;
    EXPECT_TRUE(frame < 5 || right_first);
  }
}

}  // namespace
}  // namespace ph::segment
