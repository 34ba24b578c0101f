// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ph/error.hpp"
#include "tests/libsegment/supports/room.hpp"

namespace ph::segment {
namespace {

using namespace test;

TEST(Surfaces, AWallIsNoObject) {
  const Room room({kTable, kLeft, kRight, kWall});
  const Segmentation s = room.segmented();
  ASSERT_EQ(s.tree.surfaces.size(), 2U);
  EXPECT_EQ(s.tree.removed, 2);
  EXPECT_EQ(s.tree.surfaces[0].role, Role::support);
  EXPECT_EQ(s.tree.surfaces[0].plane, *s.tree.plane);
  EXPECT_EQ(s.tree.surfaces[1].role, Role::wall);
  expect_direction(s.tree.surfaces[1].plane.normal, {0, -1, 0});
  EXPECT_NEAR(s.tree.surfaces[1].plane.offset, 0.6, 0.005);
  ASSERT_EQ(s.cut.segments.size(), 2U);
  EXPECT_GT(room.share_on(s, 0, 1), 0.9);
  EXPECT_GT(room.share_on(s, 3, 2), 0.9);
  for (const Segment& segment : s.cut.segments) {
    EXPECT_EQ(segment.role, Role::object);
    EXPECT_EQ(segment.on, (StandsOn{1, 0}));
  }
  // Checks that the wall is not a segment in any cut of the tree.
  const std::string tree = tree_bytes(s.tree);
  const SceneTree again = read_tree(Input::view(tree, "tree"));
  EXPECT_EQ(again.surfaces, s.tree.surfaces);
  for (const double value : {0.3, 1.0, 4.0})
    EXPECT_EQ(cut(again, {.value = value, .objects = false}).segments.size(), 2U) << value;
  EXPECT_EQ(cut(again, again.first_cut).surface_labels, s.cut.surface_labels);
}

TEST(Surfaces, WhatOneSeesBehindIsNoWall) {
  // A sheet stands on the table, and the table is visible behind it.
  const Block sheet{{-0.4, 0.2, 0}, {0.4, 0.21, 0.25}};
  const Room room({kTable, kLeft, sheet, {{-0.5, 1.2, -0.1}, {0.5, 1.22, 0.6}}});
  const Segmentation s = room.segmented();
  EXPECT_NE(room.label_of(s, 2), 0U);
  EXPECT_EQ(std::ranges::count(s.tree.surfaces, Role::wall, &SceneSurface::role), 1)
      << "far behind";
  EXPECT_EQ(room.label_of(s, 3), 0U);
}

TEST(Surfaces, OnlyTheSurfaceMethodHasWalls) {
  const Room room({kTable, kLeft, kWall});
  EXPECT_EQ(room.segmented({.method = Method::supervoxels}).tree.surfaces.size(), 1U);
  EXPECT_EQ(room.segmented({.method = Method::paper}).tree.surfaces.size(), 1U);
  const Segmentation all = room.segmented({.plane = false});
  EXPECT_TRUE(all.tree.surfaces.empty());
  EXPECT_EQ(std::ranges::count(all.cut.surface_labels, 0), std::ssize(all.cut.surface_labels));
  for (const Segment& segment : all.cut.segments) EXPECT_EQ(segment.role, Role::object);
}

TEST(Surfaces, WhatStandsOnTheFloorIsFound) {
  const Block floor{{-3, -3, -0.42}, {3, 3, -0.4}}, table{{-0.3, -0.3, -0.02}, {0.3, 0.3, 0}};
  const Block crate{{0.55, 0.1, -0.4}, {0.75, 0.3, -0.15}};
  const Room room({floor, table, crate, {{-0.1, -0.1, 0}, {0.05, 0.05, 0.1}}});
  const Segmentation s = room.segmented();
  ASSERT_GE(s.tree.surfaces.size(), 1U);
  const std::uint32_t low = room.label_of(s, 2), high = room.label_of(s, 3);
  ASSERT_NE(low, 0U);
  ASSERT_NE(high, 0U);
  EXPECT_NE(low, high);
  // The surface with more points comes first. It may be either of the two.
  for (const auto& [block, label] : {std::pair{0, low}, std::pair{1, high}}) {
    const std::uint32_t number = s.cut.segments[label - 1].on.surface;
    ASSERT_GE(number, 1U) << block;
    EXPECT_EQ(s.tree.surfaces[number - 1].role, block == 0 ? Role::floor : Role::support);
    EXPECT_GT(room.share_on(s, block, static_cast<int>(number)), 0.8) << block;
  }
}

TEST(Surfaces, ALowerTableIsASecondSupport) {
  const Block lower{{0.35, -0.4, -0.17}, {0.8, 0.3, -0.15}},
      table{{-0.6, -0.5, -0.02}, {0.3, 0.5, 0}};
  const Block box{{0.5, -0.1, -0.15}, {0.62, 0.02, -0.05}};
  const Room room({table, kLeft, lower, box});
  const Segmentation s = room.segmented();
  ASSERT_EQ(s.tree.surfaces.size(), 2U);
  EXPECT_EQ(s.tree.removed, 2);
  EXPECT_NEAR(s.tree.surfaces[1].plane.offset, 0.15, 0.005);
  EXPECT_GT(room.share_on(s, 2, 2), 0.8);
  const std::uint32_t label = room.label_of(s, 3);
  ASSERT_NE(label, 0U);
  EXPECT_EQ(s.cut.segments[label - 1].on, (StandsOn{2, 0}));
  EXPECT_EQ(s.cut.segments[room.label_of(s, 1) - 1].on, (StandsOn{1, 0}));
  const std::string tree = tree_bytes(s.tree);
  const SceneTree again = read_tree(Input::view(tree, "tree"));
  EXPECT_EQ(tree_bytes(again), tree);
  EXPECT_EQ(cut(again, again.first_cut).segments, s.cut.segments);
}

TEST(Surfaces, ALargeBoardIsASupportASmallOneIsAnObject) {
  for (const double width : {0.3, 0.7}) {
    const Block board{{-width / 2, 0.02, 0.13}, {width / 2, 0.42, 0.15}};
    // The box hides so much of the board that less than the least area is visible.
    const Block box{{-0.2, 0.12, 0.15}, {0.2, 0.27, 0.35}};
    const Room room({kTable, board, box});
    const Segmentation s = room.segmented();
    const std::uint32_t of_board = room.label_of(s, 1), of_box = room.label_of(s, 2);
    ASSERT_NE(of_box, 0U) << width;
    const StandsOn on = s.cut.segments[of_box - 1].on;
    if (width > 0.5) {
      EXPECT_EQ(of_board, 0U);
      ASSERT_EQ(s.tree.surfaces.size(), 2U);
      EXPECT_EQ(s.tree.surfaces[0].role, Role::support);
      EXPECT_EQ(s.tree.surfaces[1].role, Role::shelf);
      EXPECT_GT(room.share_on(s, 1, static_cast<int>(on.surface)), 0.9);
    } else {
      EXPECT_EQ(s.tree.surfaces.size(), 1U);
      EXPECT_EQ(on, (StandsOn{0, of_board}));
    }
  }
}

TEST(Surfaces, TheTopOfALargeBoxIsNoBoard) {
  const Room room({{{-2, -2, -0.02}, {2, 2, 0}}, {{-0.3, 0, 0}, {0.3, 0.5, 0.2}}});
  const Segmentation s = room.segmented();
  EXPECT_EQ(s.tree.surfaces.size(), 1U);
  EXPECT_NE(room.label_of(s, 1), 0U);
}

TEST(Surfaces, AShelfHasBoards) {
  // Three boards, each 0.3 m above the next one. From above, each hides a part of the lower one.
  const Block low{{-0.5, -0.3, -0.32}, {0.5, 0.3, -0.3}}, middle{{-0.5, 0, -0.02}, {0.5, 0.3, 0}},
      high{{-0.5, 0.2, 0.28}, {0.5, 0.6, 0.3}};
  const Block on_low{{-0.1, -0.2, -0.3}, {0, -0.1, -0.2}}, on_middle{{0.1, 0, 0}, {0.2, 0.1, 0.1}},
      on_high{{-0.2, 0.3, 0.3}, {-0.1, 0.4, 0.4}};
  const Room room({low, middle, high, on_low, on_middle, on_high});
  const Segmentation s = room.segmented();
  ASSERT_EQ(s.tree.surfaces.size(), 3U);
  EXPECT_EQ(s.cut.segments.size(), 3U);
  for (const int board : {0, 1, 2}) {
    const std::uint32_t label = room.label_of(s, board + 3);
    ASSERT_NE(label, 0U) << board;
    EXPECT_GT(room.share_on(s, board, static_cast<int>(s.cut.segments[label - 1].on.surface)), 0.9)
        << board;
  }
  const Segmentation one = room.segmented({.most_supports = 1});
  EXPECT_EQ(one.tree.surfaces.size(), 1U);
  EXPECT_THROW(room.segmented({.most_supports = 0}), Error);
}

TEST(Surfaces, ATableHasLegs) {
  const auto leg = [](double x, double y) {
    return Block{{x, y, -0.7}, {x + 0.05, y + 0.05, -0.02}};
  };
  const Block floor{{-3, -3, -0.72}, {3, 3, -0.7}}, table{{-0.5, -0.3, -0.02}, {0.5, 0.3, 0}};
  // What is as high as the table, but not slender, and what is slender, but lower, is no leg.
  const Block bin{{-0.9, -0.3, -0.7}, {-0.65, 0, -0.04}},
      post{{0.7, -0.2, -0.7}, {0.75, -0.15, -0.2}};
  // The crate is higher than the table, but it stands on the floor.
  const Block crate{{0.6, 0.1, -0.7}, {0.9, 0.4, 0.2}};
  const Room room({floor, table, leg(-0.5, -0.3), leg(0.45, -0.3), bin, post, crate, kLeft});
  const Segmentation s = room.segmented();
  const auto segment = [&](int block) { return s.cut.segments.at(room.label_of(s, block) - 1); };
  for (const int block : {2, 3}) EXPECT_EQ(segment(block).role, Role::support) << block;
  for (const int block : {4, 5, 6, 7}) EXPECT_EQ(segment(block).role, Role::object) << block;
  for (const int block : {4, 5, 6})
    EXPECT_GT(room.share_on(s, 0, static_cast<int>(segment(block).on.surface)), 0.8) << block;
  EXPECT_GT(room.share_on(s, 1, static_cast<int>(segment(7).on.surface)), 0.8);
}

TEST(Surfaces, ALegMayBeTornIntoPieces) {
  const auto piece = [](double x, double bottom, double top) {
    return Block{{x, -0.3, bottom}, {x + 0.05, -0.25, top}};
  };
  const Block floor{{-3, -3, -0.72}, {3, 3, -0.7}}, table{{-0.5, -0.3, -0.02}, {0.5, 0.3, 0}};
  // The upper piece touches the table. The last one is as low as the lower piece, but under no leg.
  const Room room(
      {floor, table, piece(-0.5, -0.3, -0.02), piece(-0.5, -0.7, -0.4), piece(0.1, -0.7, -0.4)});
  const Segmentation s = room.segmented();
  const auto role = [&](int block) { return s.cut.segments.at(room.label_of(s, block) - 1).role; };
  for (const int block : {2, 3}) EXPECT_EQ(role(block), Role::support) << block;
  EXPECT_EQ(role(4), Role::object);
}

TEST(Surfaces, TheTableHidesTheUpperEndsOfItsLegs) {
  const auto leg = [](double x, double y) {
    return Block{{x, y, -0.7}, {x + 0.05, y + 0.05, -0.02}};
  };
  const Block floor{{-3, -3, -0.72}, {3, 3, -0.7}}, table{{-0.5, -0.3, -0.02}, {0.5, 0, 0}};
  const Block low{{-0.04, -0.29, -0.7}, {0.04, -0.21, -0.4}};
  // One sees that the post under the table is too low, and the one beside the table is no leg.
  const Room room({floor, table, leg(-0.5, -0.3), leg(0.45, -0.3), leg(-0.5, -0.05),
                   leg(0.45, -0.05), low, leg(0.7, -0.05)});
  const Segmentation s = room.segmented();
  const auto segment = [&](int block) { return s.cut.segments.at(room.label_of(s, block) - 1); };
  for (const int block : {2, 3, 4, 5}) EXPECT_EQ(segment(block).role, Role::support) << block;
  for (const int block : {6, 7}) EXPECT_EQ(segment(block).role, Role::object) << block;
  EXPECT_NEAR(segment(4).oriented_box.size[2], 0.3, 0.05);
  // The box of the table is in the result and in a stored tree.
  const auto is_table = [](const SceneSurface& surface) { return surface.role == Role::support; };
  const auto found = std::ranges::find_if(s.tree.surfaces, is_table);
  ASSERT_NE(found, s.tree.surfaces.end());
  const Vec3 size = found->oriented_box.size;
  EXPECT_NEAR(size[0], 1, 0.03);
  EXPECT_NEAR(size[1], 0.3, 0.03);
  EXPECT_LT(size[2], 0.06) << "its edge is seen";
  expect_direction(found->oriented_box.axes[2], {0, 0, 1});
  const std::string tree = tree_bytes(s.tree);
  const SceneTree again = read_tree(Input::view(tree, "tree"));
  EXPECT_EQ(again.surfaces, s.tree.surfaces);
  EXPECT_EQ(cut(again, again.first_cut).segments, s.cut.segments);
}

TEST(Surfaces, ACeilingFacesTheFloor) {
  // The second ceiling is so small that it is found among the components.
  for (const double first : {1.0, 1.9}) {
    std::vector<float> xyz;
    const auto add = [&](double x, double y, double z) {
      for (const double v : {x, y, z}) xyz.push_back(static_cast<float>(v));
    };
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j < 200; ++j) {
        const double x = 0.01 * i, y = 0.01 * j - 1;
        const bool is_box = x > 0.8 && x < 1.1 && std::abs(y) < 0.15;
        add(x, y, is_box ? 0.2 : 0);
        if (x > first && std::abs(y) < 2 - first) add(x, y, 2);
      }
    const Vec3 eye{0, 0, 1.2};
    const Segmentation s = segment(CloudView{xyz, eye}, {.max_range = 4, .viewpoint = eye});
    ASSERT_EQ(s.tree.surfaces.size(), 2U);
    EXPECT_EQ(s.tree.removed, first == 1 ? 2 : 1);
    EXPECT_EQ(s.tree.surfaces[0].role, Role::support);
    EXPECT_EQ(s.tree.surfaces[1].role, Role::ceiling);
    expect_direction(s.tree.surfaces[1].plane.normal, {0, 0, -1});
    EXPECT_EQ(s.cut.segments.size(), 1U);
  }
}

TEST(Surfaces, AStackStandsOnItsLowestBox) {
  const Block large{{-0.15, 0, 0}, {0.15, 0.25, 0.15}},
      small{{-0.06, 0.08, 0.15}, {0.06, 0.2, 0.25}};
  const Room room({kTable, large, small});
  const Segmentation s = room.segmented();
  const std::uint32_t below = room.label_of(s, 1), above = room.label_of(s, 2);
  ASSERT_EQ(s.cut.segments.size(), 2U);
  EXPECT_EQ(s.cut.segments[below - 1].on, (StandsOn{1, 0}));
  EXPECT_EQ(s.cut.segments[above - 1].on, (StandsOn{0, below}));
  EXPECT_EQ(s.cut.segments[above - 1].role, Role::object);
}

TEST(Surfaces, WhatIsCutOffAndStandsOnNothingIsAnObject) {
  const Block hanging{{-0.25, 0.1, 0.3}, {-0.1, 0.2, 0.42}},
      beside{{0.7, -0.3, 0.1}, {1.5, 0.0, 0.3}};
  const Block front{{0.05, -0.2, 0}, {0.45, -0.12, 0.25}},
      behind{{0.15, 0.0, 0}, {0.35, 0.12, 0.36}};
  const Room room({kTable, hanging, front, behind, beside});
  const Segmentation s = room.segmented();
  const auto segment = [&](int block) { return s.cut.segments.at(room.label_of(s, block) - 1); };
  for (const int block : {1, 2, 3, 4}) EXPECT_EQ(segment(block).role, Role::object) << block;
  EXPECT_EQ(segment(1).on, StandsOn());
  EXPECT_EQ(segment(4).on, StandsOn());
}

}  // namespace
}  // namespace ph::segment
