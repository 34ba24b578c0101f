// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "ph/error.hpp"
#include "ph/label_tracker.hpp"
#include "ph/segment.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using test::Block;

/// Blocks as seen by a sensor at (0, -0.9, 0.9) that looks down at 45 degrees. The coordinates of
/// the points are x right, y away and z up. At one metre, depth has noise of half a millimetre.
class Room {
 public:
  static constexpr Index kWidth = 640, kHeight = 480;

  explicit Room(const std::vector<Block>& blocks) {
    std::mt19937 random(3);
    std::normal_distribution<double> gauss;
    const double c = std::sqrt(0.5), focal = 340;
    for (Index v = 0; v < kHeight; ++v) {
      for (Index u = 0; u < kWidth; ++u) {
        const double px = (static_cast<double>(u) - kWidth / 2.0 + 0.5) / focal;
        const double py = (static_cast<double>(v) - kHeight / 2.0 + 0.5) / focal;
        const Vec3 ray{px, c - c * py, -c - c * py};
        double depth = kInfinity;
        int met = -1;
        for (std::size_t b = 0; b < blocks.size(); ++b)
          if (const double at = entry(blocks[b], ray); at < depth) {
            depth = at;
            met = static_cast<int>(b);
          }
        depth += 0.0005 * depth * depth * gauss(random);
        met_.push_back(met);
        for (std::size_t k = 0; k < 3; ++k)
          xyz_.push_back(met < 0 ? test::kHole : static_cast<float>(kEye[k] + depth * ray[k]));
      }
    }
  }
  CloudView view() const { return {xyz_, kEye, kWidth, kHeight}; }
  Segmentation segmented(SegmentOptions options = {}) const {
    options.max_range = 4;
    options.viewpoint = kEye;
    return segment(view(), options);
  }
  /// The label of most points of a block.
  std::uint32_t label_of(const Segmentation& s, int block) const {
    std::vector<int> count(s.cut.segments.size() + 1);
    for (std::size_t i = 0; i < met_.size(); ++i)
      if (met_[i] == block) ++count[s.cut.labels[i]];
    return static_cast<std::uint32_t>(std::ranges::max_element(count) - count.begin());
  }
  /// The share of a block's points that are on a surface.
  double share_on(const Segmentation& s, int block, int surface) const {
    double all = 0, on = 0;
    for (std::size_t i = 0; i < met_.size(); ++i) {
      if (met_[i] != block) continue;
      ++all;
      on += s.cut.surface_labels[i] == surface ? 1 : 0;
    }
    return on / all;
  }

 private:
  static constexpr Vec3 kEye{0, -0.9, 0.9};

  /// The distance along a ray to the place where it enters a block.
  static double entry(const Block& block, const Vec3& ray) {
    double near = 0, far = kInfinity;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = (block.min[k] - kEye[k]) / ray[k], b = (block.max[k] - kEye[k]) / ray[k];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near > 0 && near < far ? near : kInfinity;
  }

  std::vector<float> xyz_;
  std::vector<int> met_;  // the block that each pixel shows; -1 for none
};

const Block kTable{{-0.6, -0.5, -0.02}, {0.6, 0.5, 0}};
const Block kLeft{{-0.09, -0.05, 0}, {0.03, 0.07, 0.12}}, kRight{{0.1, -0.05, 0}, {0.2, 0.05, 0.1}};
const Block kWall{{-0.4, 0.6, -0.1}, {0.4, 0.62, 1.5}};  // taller than the height of the sensor

void expect_direction(const Vec3& found, const Vec3& expected) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 0.02) << k;
}

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

TEST(Surfaces, ACeilingFacesTheFloor) {
  std::vector<float> xyz;
  const auto add = [&](double x, double y, double z) {
    for (const double v : {x, y, z}) xyz.push_back(static_cast<float>(v));
  };
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 200; ++j) {
      const double x = 0.01 * i, y = 0.01 * j - 1;
      const bool is_box = x > 0.8 && x < 1.1 && std::abs(y) < 0.15;
      add(x, y, is_box ? 0.2 : 0);
      if (x > 1) add(x, y, 2);
    }
  const Vec3 eye{0, 0, 1.2};
  const Segmentation s = segment(CloudView{xyz, eye}, {.max_range = 4, .viewpoint = eye});
  ASSERT_EQ(s.tree.surfaces.size(), 2U);
  EXPECT_EQ(s.tree.surfaces[0].role, Role::support);
  EXPECT_EQ(s.tree.surfaces[1].role, Role::ceiling);
  expect_direction(s.tree.surfaces[1].plane.normal, {0, 0, -1});
  EXPECT_EQ(s.cut.segments.size(), 1U);
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

// ---- which plane is the support

TEST(Support, IsNotTheLargerWallBehindIt) {
  const Block table{{-0.4, -0.45, -0.02}, {0.4, 0.25, 0}}, wall{{-2, 0.25, -0.5}, {2, 0.27, 2}};
  const Room room({table, kLeft, kRight, wall});
  const Segmentation s = room.segmented();
  ASSERT_TRUE(s.tree.plane);
  EXPECT_LT(s.tree.plane->share, 0.5) << "the wall has more points";
  expect_direction(s.tree.plane->normal, {0, 0, 1});
  EXPECT_EQ(s.cut.segments.size(), 2U);
  EXPECT_GT(room.share_on(s, 3, 2), 0.7);
}

TEST(Support, IsNotASideOfAnObject) {
  const Block box{{-0.15, -0.1, -0.2}, {0.15, 0.2, 0.1}};
  const Room room({box});
  const Segmentation s = room.segmented();
  EXPECT_FALSE(s.tree.plane);
  EXPECT_NE(s.plane_note.find("goes on behind"), std::string::npos) << s.plane_note;
  EXPECT_EQ(s.cut.segments.size(), 1U);
  EXPECT_EQ(s.cut.segments[0].role, Role::object);
}

TEST(Support, IsNotACardInTheAir) {
  const Block card{{-0.1, -0.1, 0}, {0.1, 0.1, 0.002}};
  const Segmentation alone = Room({card}).segmented();
  EXPECT_FALSE(alone.tree.plane);
  EXPECT_NE(alone.plane_note.find("nothing is on it"), std::string::npos) << alone.plane_note;
  EXPECT_EQ(alone.cut.segments.size(), 1U);
  // A larger plane is found, because it is an empty table.
  EXPECT_TRUE(Room({kTable}).segmented().tree.plane);
  // A small tray with something in its middle is a support.
  const Block tray{{-0.2, -0.2, -0.01}, {0.2, 0.2, 0}}, cube{{-0.03, -0.03, 0}, {0.03, 0.03, 0.06}};
  const Segmentation with_cube = Room({tray, cube}).segmented();
  EXPECT_TRUE(with_cube.tree.plane);
  EXPECT_EQ(with_cube.cut.segments.size(), 1U);
}

// ---- containers

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

// ---- from frame to frame

TEST(PlaneGuess, IsTakenWhileThePointsAgree) {
  const Room room({kTable, kLeft, kRight});
  const Segmentation alone = room.segmented();
  Plane guess = *alone.tree.plane;
  guess.offset += 0.001;  // the amount by which noise may move the plane
  const Segmentation next = room.segmented({.plane_guess = guess});
  EXPECT_EQ(next.cut.labels, alone.cut.labels);
  EXPECT_NEAR(next.tree.plane->offset, alone.tree.plane->offset, 1e-4) << "it is fitted again";
  // If the plane is far from the guess, the search starts from scratch.
  guess.offset += 0.3;
  EXPECT_EQ(room.segmented({.plane_guess = guess}).tree.plane, alone.tree.plane);
  guess.normal = {1, 1, 0};
  EXPECT_THROW(room.segmented({.plane_guess = guess}), Error);
}

TEST(CameraMotion, IsToldFromThePlane) {
  SceneTree before, after;
  EXPECT_FALSE(camera_motion(before, after));
  before.plane = Plane{{0, 0, 1}, -0.9};
  before.viewpoint = {0, 0, 1.9};  // one metre above the plane
  EXPECT_FALSE(camera_motion(before, after)) << "one has no plane";
  after = before;
  EXPECT_FALSE(camera_motion(before, after));
  const auto turned = [&](double degrees) {
    const double a = degrees * std::acos(-1.0) / 180;
    // A rotation about the foot of the viewpoint keeps the distance to the plane.
    SceneTree scene = before;
    scene.plane = Plane{{std::sin(a), 0, std::cos(a)}, 1 - 1.9 * std::cos(a)};
    return camera_motion(before, scene);
  };
  EXPECT_FALSE(turned(0.4));
  ASSERT_TRUE(turned(0.6));
  EXPECT_NEAR(turned(30)->turn, 30, 1e-9);
  EXPECT_NEAR(turned(30)->shift, 0, 1e-9);
  EXPECT_NEAR(turned(180)->turn, 180, 1e-9);
  after.viewpoint[2] -= 0.02;
  ASSERT_TRUE(camera_motion(before, after));
  EXPECT_NEAR(camera_motion(before, after)->shift, -0.02, 1e-12);
  after.viewpoint[2] += 0.016;  // 4 mm in total
  EXPECT_FALSE(camera_motion(before, after));
  before.viewpoint[2] += 2, after = before;  // at three metres, the noise is nine times as large
  after.viewpoint[2] += 0.04;
  EXPECT_FALSE(camera_motion(before, after));
}

}  // namespace
}  // namespace ph::segment
