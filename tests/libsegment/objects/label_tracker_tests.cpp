// SPDX-License-Identifier: MIT
#include "ph/label_tracker.hpp"

#include <gtest/gtest.h>

#include "ph/segment.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using Labels = std::vector<std::uint32_t>;

TEST(LabelTracker, AnObjectKeepsItsNumber) {
  LabelTracker tracker;
  EXPECT_EQ(tracker.update(Labels{1, 1, 1, 0, 2, 2}), (Labels{1, 1, 1, 0, 2, 2}));
  // The order of the segments by size changes, but the segments keep their numbers.
  EXPECT_EQ(tracker.update(Labels{2, 2, 0, 1, 1, 1}), (Labels{1, 1, 0, 2, 2, 2}));
  // A new object gets the number 3, although it is the largest.
  EXPECT_EQ(tracker.update(Labels{3, 1, 1, 1, 2, 2}), (Labels{1, 3, 3, 3, 2, 2}));
  EXPECT_EQ(tracker.update(Labels{0, 0, 0, 0, 0, 0}), (Labels{0, 0, 0, 0, 0, 0}));
}

TEST(LabelTracker, NoObjectIsTakenTwice) {
  LabelTracker tracker;
  tracker.update(Labels{1, 1, 1, 1, 1, 1});
  // If an object splits, its larger part keeps the number.
  EXPECT_EQ(tracker.update(Labels{2, 2, 1, 1, 1, 1}), (Labels{2, 2, 1, 1, 1, 1}));
  // If the objects merge again, the result gets the number of the object with which it shares more
  // points.
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

/// A frame of two rows. It has the label and the surface of each point, and the surface or segment
/// on which each segment stands. Surfaces are numbered from 2, because surface 1 was removed.
struct Frame : Segmentation {
  Frame(const Labels& drawn, std::vector<std::uint8_t> found, std::vector<Standing> standing,
        std::vector<Role> roles = {Role::wall}) {
    tree.width = static_cast<Index>(drawn.size() / 2);
    tree.height = 2;
    cut.labels = drawn;
    cut.surface_labels = std::move(found);
    tree.removed_with.resize(drawn.size());
    tree.removed = 1;
    tree.vertices = tree.normals = Points(0, 3);
    tree.surfaces.push_back({Role::support, {}});
    for (const Role role : roles) tree.surfaces.push_back({role, {}});
    for (const Standing& s : standing) {
      Segment& segment = cut.segments.emplace_back();
      segment.label = static_cast<std::uint32_t>(cut.segments.size());
      segment.role = s.role;
      segment.on = s.on;
    }
  }
};

constexpr Standing kOnTable{Role::object, {1, 0}}, kNowhere{Role::container, {}};
const std::vector<std::uint8_t> kNoWall(8);

TEST(LabelTracker, ARoleAndASupportChangeAfterThreeFramesThatSaySo) {
  const Labels one = {1, 1, 1, 0, 1, 1, 1, 0};
  const Frame stands(one, kNoWall, {kOnTable}), hidden(one, kNoWall, {kNowhere});
  LabelTracker tracker;
  const auto seen = [&](const Frame& frame) {
    EXPECT_EQ(tracker.update(frame.tree, frame.cut), Labels{1});
    return tracker.standings().front();
  };
  EXPECT_EQ(seen(hidden), kNowhere) << "there is nothing to hold on to in the first frame";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(seen(stands), kNowhere);
  EXPECT_EQ(seen(hidden), kNowhere) << "now they have to begin anew";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(seen(stands), kNowhere);
  EXPECT_EQ(seen(stands), kOnTable);
  EXPECT_EQ(seen(hidden), kOnTable);
  const Frame leans(one, kNoWall, {{Role::object, {}}});
  EXPECT_EQ(seen(leans), kOnTable);
  EXPECT_EQ(seen(hidden), kOnTable) << "three frames, but they do not say the same";
}

TEST(LabelTracker, AWallThatIsASegmentForAFrameIsStillAWall) {
  const Labels object = {1, 1, 0, 0, 1, 1, 0, 0}, both = {1, 1, 2, 2, 1, 1, 2, 2};
  const Frame wall(object, {0, 0, 2, 2, 0, 0, 2, 2}, {kOnTable});
  const Frame segment(both, kNoWall, {kOnTable, kNowhere}, {});
  LabelTracker tracker;
  const auto role_of_second = [&] {
    EXPECT_EQ(tracker.update(segment.tree, segment.cut), (Labels{1, 2}));
    EXPECT_EQ(tracker.standings()[0], kOnTable);
    return tracker.standings()[1].role;
  };
  EXPECT_EQ(tracker.update(wall.tree, wall.cut), Labels{1});
  EXPECT_EQ(role_of_second(), Role::wall);
  EXPECT_EQ(tracker.update(wall.tree, wall.cut), Labels{1});
  for (int i = 0; i < 2; ++i) EXPECT_EQ(role_of_second(), Role::wall);
  EXPECT_EQ(role_of_second(), Role::container) << "the third frame in a row";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(tracker.update(wall.tree, wall.cut), Labels{1});
  EXPECT_EQ(role_of_second(), Role::container);
}

TEST(LabelTracker, WhatAnObjectStandsOnIsKnownByItsNumber) {
  const Frame other({0, 0, 0, 1, 0, 0, 0, 1}, kNoWall, {kOnTable});
  const Frame all({1, 1, 2, 3, 1, 1, 2, 3}, kNoWall, {kOnTable, {Role::object, {0, 1}}, kOnTable});
  const Frame swapped({2, 2, 1, 3, 2, 2, 1, 3}, kNoWall, {kNowhere, kOnTable, kOnTable});
  LabelTracker tracker;
  tracker.update(other.tree, other.cut);
  EXPECT_EQ(tracker.update(all.tree, all.cut), (Labels{2, 3, 1}));
  EXPECT_EQ(tracker.update(swapped.tree, swapped.cut), (Labels{3, 2, 1}));
  EXPECT_EQ(tracker.standings().front(), (Standing{Role::object, {0, 2}}));
}

TEST(LabelTracker, WhatAnObjectStandsOnIsNamedAsInTheFrame) {
  const Labels stack = {1, 1, 2, 0, 1, 1, 2, 0}, swapped = {2, 2, 1, 0, 2, 2, 1, 0};
  const Standing on_first{Role::object, {0, 1}}, on_second{Role::object, {0, 2}};
  const Frame first(stack, kNoWall, {kOnTable, on_first});
  LabelTracker tracker;
  tracker.update(first.tree, first.cut);
  // The labels are swapped. In this single frame, the lower object appears to stand on the upper
  // one.
  const Frame wrong(swapped, kNoWall, {kOnTable, on_first});
  EXPECT_EQ(tracker.update(wrong.tree, wrong.cut), (Labels{2, 1}));
  EXPECT_EQ(tracker.standings(), (std::vector{on_second, kOnTable}));
  // The lower object is missing. In this case, the current frame decides.
  const Frame alone({0, 0, 1, 0, 0, 0, 1, 0}, kNoWall, {kNowhere});
  EXPECT_EQ(tracker.update(alone.tree, alone.cut), Labels{2});
  EXPECT_EQ(tracker.standings(), (std::vector<Standing>{{Role::object, {}}}));
  // The current frame also decides if the surface now has another role, or has disappeared.
  const Frame on_board({1, 1, 0, 0, 1, 1, 0, 0}, {0, 0, 2, 2, 0, 0, 2, 2}, {{Role::object, {2, 0}}},
                       {Role::support});
  const Frame by_wall({1, 1, 0, 0, 1, 1, 0, 0}, {0, 0, 2, 2, 0, 0, 2, 2}, {kOnTable});
  const Frame bare({1, 1, 0, 0, 1, 1, 0, 0}, kNoWall, {kOnTable}, {});
  for (const Frame* other : {&by_wall, &bare}) {
    LabelTracker fresh;
    fresh.update(on_board.tree, on_board.cut);
    fresh.update(other->tree, other->cut);
    EXPECT_EQ(fresh.standings().front(), kOnTable);
  }
}

TEST(LabelTracker, VoxelsOfAnotherSizeShowTheSameObjects) {
  const Cloud cloud = test::TableScene::two_boxes().cloud();
  LabelTracker tracker;
  std::size_t frame = 0;
  for (const double voxel : {0.005, 0.0075, 0.01125, 0.006, 0.005}) {
    Segmentation s = segment(cloud, {.voxel = voxel, .min_part = 30});
    s.tree.width *= s.tree.height, s.tree.height = 1;
    ASSERT_EQ(s.cut.segments.size(), 2U);
    EXPECT_EQ(tracker.update(s.tree, s.cut), (Labels{1, 2})) << frame++;
  }
}

TEST(LabelTracker, AMovingScene) {
  LabelTracker pixels, voxels;
  for (int frame = 0; frame < 6; ++frame) {
    const double x = 0.01 * frame;
    // The right box grows until it has more points than the left box. Labels are sorted by size, so
    // they are swapped then.
    const double more = 0.02 * frame;
    const test::TableScene scene({{{-0.22 + x, -0.05, 0}, {-0.10 + x, 0.07, 0.12}},
                                  {{0.10, -0.05, 0}, {0.2 + more, 0.05, 0.1}}});
    const Cloud cloud = scene.cloud();
    Segmentation s = segment(cloud);
    ASSERT_EQ(s.cut.segments.size(), 2U);
    const bool right_first = s.cut.segments[0].centroid[0] > 0;
    const Labels expected = right_first ? Labels{2, 1} : Labels{1, 2};
    EXPECT_EQ(pixels.update(s.tree, s.cut), expected) << frame;
    s.tree.width *= s.tree.height, s.tree.height = 1;  // makes the cloud appear unorganised
    EXPECT_EQ(voxels.update(s.tree, s.cut), expected) << frame;
    EXPECT_TRUE(frame < 5 || right_first);
  }
}

}  // namespace
}  // namespace ph::segment
