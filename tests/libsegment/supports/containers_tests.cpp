// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "tests/libsegment/supports/room.hpp"

namespace ph::segment {
namespace {

using namespace test;

/// A bin without a lid: its floor and its four walls. The right wall is last.
std::vector<Block> bin() {
  constexpr double w = 0.26, d = 0.2, high = 0.12, thick = 0.01;
  return {{{-w, -d, 0}, {w, d, thick}},
          {{-w, d - thick, 0}, {w, d, high}},
          {{-w, -d, 0}, {w, -d + thick, high}},
          {{-w, -d, 0}, {-w + thick, d, high}},
          {{w - thick, -d, 0}, {w, d, high}}};
}

TEST(Containers, ABinIsOneSegment) {
  std::vector<Block> blocks{kTable};
  for (const Block& part : bin()) blocks.push_back(part);
  blocks.push_back({{-0.18, -0.02, 0.01}, {-0.1, 0.06, 0.07}});
  blocks.push_back({{-0.04, 0.02, 0.01}, {0.04, 0.1, 0.07}});
  blocks.push_back({{0.1, -0.04, 0.01}, {0.18, 0.04, 0.07}});
  const Room room(blocks);
  const Segmentation s = room.segmented();
  const std::uint32_t container = room.label_of(s, 1);
  ASSERT_NE(container, 0U);
  EXPECT_EQ(s.cut.segments[container - 1].role, Role::container);
  for (const int wall : {2, 3, 4, 5}) EXPECT_EQ(room.label_of(s, wall), container) << wall;
  for (const int thing : {6, 7, 8}) {
    const std::uint32_t label = room.label_of(s, thing);
    ASSERT_NE(label, 0U);
    EXPECT_NE(label, container);
    EXPECT_EQ(s.cut.segments[label - 1].role, Role::object);
    EXPECT_EQ(s.cut.segments[label - 1].on, (StandsOn{0, container}));
  }
  EXPECT_EQ(s.cut.segments[container - 1].on, (StandsOn{1, 0}));
  EXPECT_EQ(cut(s.tree, s.tree.first_cut).segments, s.cut.segments);
}

TEST(Containers, WallsInOnePartHaveAFloor) {
  // The rim is so thick that it joins the walls.
  const double z = 0.1;
  const Room room({kTable,
                   {{-0.26, -0.16, 0}, {0.26, 0.16, 0.01}},
                   {{-0.28, -0.18, 0}, {-0.26, 0.18, z}},
                   {{0.26, -0.18, 0}, {0.28, 0.18, z}},
                   {{-0.26, -0.18, 0}, {0.26, -0.16, z}},
                   {{-0.26, 0.16, 0}, {0.26, 0.18, z}},
                   {{-0.18, -0.02, 0.01}, {-0.1, 0.06, 0.07}},
                   {{-0.04, 0.02, 0.01}, {0.04, 0.1, 0.07}},
                   {{0.1, -0.04, 0.01}, {0.18, 0.04, 0.07}}});
  const Segmentation s = room.segmented();
  const std::uint32_t container = room.label_of(s, 1);
  ASSERT_NE(container, 0U);
  EXPECT_EQ(s.cut.segments[container - 1].role, Role::container);
  for (const int wall : {2, 3, 4, 5}) EXPECT_EQ(room.label_of(s, wall), container) << wall;
  EXPECT_EQ(s.cut.segments.size(), 4U);
}

TEST(Containers, PartsOfOneVoxelAreNone) {
  // A plane and single points in front of it, each of which is a part.
  std::vector<float> xyz;
  for (int i = -70; i < 70; ++i)
    for (int k = -70; k < 70; ++k)
      xyz.insert(xyz.end(), {0.004F * static_cast<float>(i), 0.004F * static_cast<float>(k), 1});
  for (int i = 0; i < 5; ++i) xyz.insert(xyz.end(), {0.04F * static_cast<float>(i), 0, 0.9F});
  const Segmentation s =
      segment(CloudView{xyz, {}}, {.voxel = 0.005, .min_size = 1, .min_part = 1});
  ASSERT_TRUE(s.tree.plane);
  EXPECT_EQ(s.cut.segments.size(), 5U);
  for (const Segment& segment : s.cut.segments) EXPECT_EQ(segment.role, Role::object);
}

TEST(Containers, TwoThingsAreTooFewAndABoxBelowThreeIsNone) {
  std::vector<Block> blocks{kTable};
  for (const Block& part : bin()) blocks.push_back(part);
  blocks.push_back({{-0.18, -0.02, 0.01}, {-0.1, 0.06, 0.07}});
  blocks.push_back({{0.1, -0.04, 0.01}, {0.18, 0.04, 0.07}});
  const Block box{{-0.25, 0, 0}, {0.25, 0.2, 0.1}};
  std::vector<Block> on_box{kTable, box};
  for (const double x : {-0.15, 0.0, 0.15})
    on_box.push_back({{x - 0.03, 0.05, 0.1}, {x + 0.03, 0.12, 0.16}});
  for (const auto& scene : {blocks, on_box})
    for (const Segment& segment : Room(scene).segmented().cut.segments)
      EXPECT_EQ(segment.role, Role::object);
}

}  // namespace
}  // namespace ph::segment
