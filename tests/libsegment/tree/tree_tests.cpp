// SPDX-License-Identifier: MIT
// Cuts of a scene's merge tree, and the file that stores the tree.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "libsegment/src/tree/tree_file.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/libsegment/vessel_scene.hpp"
#include "tests/support/points.hpp"
#include "tests/support/test_data.hpp"

namespace ph::segment {
namespace {

namespace fs = std::filesystem;
using test::TableScene;

SceneTree read_again(const std::string& bytes) { return read_tree(Input::view(bytes, "s.tree")); }

void expect_same(const SceneCut& a, const SceneCut& b) {
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.vertex_labels, b.vertex_labels);
  EXPECT_EQ(a.segments, b.segments);
}

/// A box on another box, and next to them a third box. A bar in front of the third box hides its
/// middle.
TableScene stack() {
  return TableScene({{{-0.2, -0.05, 0}, {0.0, 0.15, 0.08}},
                     {{-0.14, 0.0, 0.08}, {-0.06, 0.1, 0.2}},
                     {{0.05, 0.0, 0}, {0.35, 0.1, 0.1}},
                     {{0.18, -0.1, 0}, {0.22, -0.06, 0.2}}});
}

class StoredTree : public testing::TestWithParam<Method> {
 protected:
  SegmentOptions options() const { return {.method = GetParam()}; }
  Segmentation segmented(const TableScene& scene) const {
    return segment(CloudView{scene.xyz(), {}}, options());
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, StoredTree,
                         testing::Values(Method::surface, Method::paper, Method::supervoxels),
                         [](const auto& method) {
                           return std::string(test::name_of(method.param));
                         });

TEST_P(StoredTree, GivesTheSameSegments) {
  for (const TableScene& scene : {TableScene::two_boxes(), stack(), TableScene({})}) {
    const Segmentation s = segmented(scene);
    const std::string bytes = tree_bytes(s.tree);
    const SceneTree again = read_again(bytes);
    EXPECT_EQ(tree_bytes(again), bytes);
    EXPECT_EQ(again.merge_tree.merges, s.tree.merge_tree.merges);
    EXPECT_EQ(again.merge_tree.births, s.tree.merge_tree.births);
    EXPECT_EQ(again.plane, s.tree.plane);
    EXPECT_EQ(again.first_cut, s.tree.first_cut);
    expect_same(cut(again, again.first_cut), s.cut);
    expect_same(cut(s.tree, s.tree.first_cut), s.cut);
  }
}

TEST(StoredTreeSurface, OtherCutsAreThoseOfAnotherRun) {
  const TableScene scene = stack();
  const CloudView cloud{scene.xyz(), {}};
  const SceneTree tree = read_again(tree_bytes(segment(cloud).tree));
  for (const double value : {0.0, 2.0, 30.0, kInfinity}) {
    for (const Index min_part : {Index{1}, Index{400}}) {
      for (const bool objects : {true, false}) {
        const SegmentOptions o{
            .min_size = 20, .min_persistence = value, .objects = objects, .min_part = min_part};
        expect_same(cut(tree, o.cut()), segment(cloud, o).cut);
      }
    }
  }
}

TEST(StoredTreePaper, OtherCutsAreSingleLinkageAtThatDistance) {
  const TableScene scene(
      {{{-0.12, -0.05, 0}, {-0.02, 0.05, 0.1}}, {{0.02, -0.05, 0}, {0.12, 0.05, 0.1}}});
  const CloudView cloud{scene.xyz(), {}};
  SegmentOptions o{.method = Method::paper, .distance = 0.06, .steps = 0};
  const SceneTree tree = read_again(tree_bytes(segment(cloud, o).tree));
  for (const double distance : {0.0, 0.011, 0.02, 0.03, 0.05, 0.06}) {
    o.distance = distance;
    EXPECT_EQ(cut(tree, {.value = distance}).labels, segment(cloud, o).cut.labels) << distance;
  }
  EXPECT_EQ(cut(tree, {.value = 0.03}).segments.size(), 2U);
  EXPECT_EQ(cut(tree, {.value = 0.06}).segments.size(), 1U);
}

TEST_P(StoredTree, Explains) {
  const Segmentation s = segmented(stack());
  const SceneTree again = read_again(tree_bytes(s.tree));
  const SceneCut cut_again = cut(again, again.first_cut);
  for (std::uint32_t a = 1; a <= s.cut.segments.size(); ++a) {
    for (std::uint32_t b = 1; b < a; ++b) {
      const auto meeting = first_meeting(s, a, b), same = first_meeting(again, cut_again, a, b);
      ASSERT_EQ(meeting.has_value(), same.has_value());
      if (!meeting) continue;
      EXPECT_EQ(meeting->value, same->value);
      EXPECT_EQ(meeting->at, same->at);
    }
  }
}

TEST_P(StoredTree, OptionsOutOfRange) {
  const Segmentation s = segmented(stack());
  for (const CutOptions& bad : {CutOptions{.value = -1}, CutOptions{.value = std::nan("")},
                                CutOptions{.min_part = 0}, CutOptions{.min_size = 0}})
    EXPECT_THROW(cut(s.tree, bad), Error);
  if (GetParam() == Method::paper) {
    EXPECT_THROW(cut(s.tree, {.value = 0.026}), Error);
  }
}

TEST_P(StoredTree, AsJson) {
  const Segmentation s = segmented(stack());
  const std::string json = tree_json(s.tree);
  const auto has = [&](const std::string& text) { return json.find(text) != std::string::npos; };
  EXPECT_TRUE(has("\"format\": \"ph-segment-tree\""));
  EXPECT_TRUE(has(GetParam() == Method::paper ? "\"steps\": 10," : "\"steps\": null,"));
  const Merge& m = s.tree.merge_tree.merges[7];
  EXPECT_TRUE(
      has(fmt::format("\"edge\": [{}, {}], \"elder\": {}, \"younger\": {}, \"elder_size\": {}, "
                      "\"younger_size\": {}",
                      m.u, m.v, m.elder, m.younger, m.elder_size, m.younger_size)));
  EXPECT_TRUE(has(fmt::format("\"centroid\": [{}", shortest(s.tree.vertices(5, 0)))));
  const auto count = [&](const std::string& text) {
    std::size_t n = 0;
    for (auto at = json.find(text); at != json.npos; at = json.find(text, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("\"birth\""), s.tree.counts.size());
  EXPECT_EQ(count("\"edge\""), s.tree.merge_tree.merges.size());
  const std::string points = json.substr(json.find("\"vertex_of_point\""));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(points, ',')) + 1, s.cut.labels.size());
}

// ---- trees that are refused

std::string with_right_sum(std::string bytes) {
  const std::uint32_t sum = tree_sum(std::string_view(bytes).substr(0, bytes.size() - kTreeSum));
  for (std::size_t k = 0; k < kTreeSum; ++k)
    bytes[bytes.size() - kTreeSum + k] = static_cast<char>(sum >> (8 * k) & 0xFF);
  return bytes;
}

/// The message with which these bytes are refused.
std::string refusal(const std::string& bytes) {
  try {
    read_again(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_data) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

/// The bytes with one word of the header replaced.
template <class T>
std::string with_word(std::string bytes, std::size_t word, T value) {
  static_assert(sizeof value == kTreeWord);
  std::memcpy(&bytes[word * kTreeWord], &value, sizeof value);
  return with_right_sum(std::move(bytes));
}

TEST(DamagedTree, EveryByteCounts) {
  const std::vector<float> xyz = {0, 0, 1, 0.004F, 0, 1, 0.02F, 0, 1, 0.5F, 0, 1};
  const std::string bytes = tree_bytes(segment(CloudView{xyz, {}}, {.min_size = 1}).tree);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_NE(refusal(damaged), "") << i;
    EXPECT_NE(refusal(bytes.substr(0, i)), "") << i;
  }
  EXPECT_NE(refusal(bytes + '\0').find("trailing data"), std::string::npos);
}

TEST(DamagedTree, HeadersThatLie) {
  const std::string bytes = tree_bytes(segment(CloudView{stack().xyz(), {}}).tree);
  const double nan = std::nan("");
  for (const std::int64_t version : {1, 2, 3, 5})
    EXPECT_NE(refusal(with_word(bytes, 1, version)).find("segment the cloud again"),
              std::string::npos);
  for (const std::size_t word : {25U, 26U, 27U})  // surfaces, removed surfaces, noise values
    for (const std::int64_t lie : {std::int64_t{-1}, std::int64_t{2}, std::int64_t{1} << 40})
      EXPECT_NE(refusal(with_word(bytes, word, lie)), "") << word << ' ' << lie;
  for (const std::int64_t lie : {std::int64_t{-1}, std::int64_t{1} << 62, std::int64_t{1} << 32}) {
    for (const std::size_t word : {3U, 4U, 5U, 6U, 7U})  // width, height, vertices, merges, points
      EXPECT_NE(refusal(with_word(bytes, word, lie)), "") << word << ' ' << lie;
  }
  for (const std::size_t word : {9U, 10U, 11U, 12U, 13U, 16U, 17U, 19U, 20U, 21U})
    EXPECT_NE(refusal(with_word(bytes, word, nan)), "") << word;
  for (const double voxel : {0.0, 1e-31, 1e31, 6e307})
    EXPECT_NE(refusal(with_word(bytes, 9, voxel)).find("voxel"), std::string::npos) << voxel;
  EXPECT_NE(refusal(with_word(bytes, 16, 0.5)).find("normal of the plane"), std::string::npos);
}

TEST(DamagedTree, SizesThatCannotBe) {
  const Segmentation s = segment(CloudView{stack().xyz(), {}});
  const std::string bytes = tree_bytes(s.tree);
  EXPECT_NE(refusal(with_word(bytes, 4, std::int64_t{0})).find("height"), std::string::npos);
  const auto n = static_cast<std::int64_t>(s.tree.vertices.rows());
  for (const std::int64_t lie : {n * (n - 1) / 2 + 1, std::int64_t{1} << 33, INT64_MAX})
    EXPECT_NE(refusal(with_word(bytes, 8, lie)).find("number of edges"), std::string::npos) << lie;
  EXPECT_EQ(read_again(with_word(bytes, 8, n * (n - 1) / 2)).edges, n * (n - 1) / 2);
}

TEST(DamagedTree, ContentsThatCannotBe) {
  const Segmentation s = segment(CloudView{stack().xyz(), {}});
  const auto damaged = [&](auto&& damage) {
    SceneTree tree = s.tree;
    damage(tree);
    return refusal(tree_bytes(tree));
  };
  const auto says = [](const std::string& message, std::string_view what) {
    return message.find(what) != std::string::npos;
  };
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.cells[7] = t.cells[6]; }), "order of the grid"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.cells[7][0] += 0.5; }), "whole number"));
  for (const std::size_t axis : {0U, 1U, 2U}) {
    EXPECT_TRUE(says(damaged([&](SceneTree& t) { t.cells.back()[axis] = 0x1p53; }), "at most"));
    EXPECT_TRUE(says(damaged([&](SceneTree& t) { t.cells.front()[axis] = -0x1p53; }), "at most"));
  }
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.vertices(3, 1) += 1; }), "centroid"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { ph::test::scale(t.normals.row(3), 2); }), "normal"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.counts[3] += 1000; }), "points of a voxel"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.merge_tree.births[3] = -1; }), "birth"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) {
                     t.method = Method::paper;  // in this method, voxels enter at 0
                     t.normals = Points(0, 3);
                     t.noise.clear();
                     t.distance = 1;
                   }),
                   "birth"));
  EXPECT_TRUE(
      says(damaged([](SceneTree& t) { t.merge_tree.merges[9].value = kInfinity; }), "merge"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.surfaces[0].role = Role::wall; }), "role"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.surfaces[0].plane.offset += 1; }), "surface"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.surfaces[0].plane.normal[0] += 1; }), "surface"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.surfaces[0].oriented_box.size[0] = -1; }), "size"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.surfaces[0].oriented_box.axes[1][2] = kInfinity; }),
                   "axis"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.noise.push_back({1, -1}); }), "noise"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.noise.assign({{2, 1}, {1, 1}}); }), "noise"));
  // Such a tree cannot be written, so the damage is done to its bytes.
  const std::size_t first_merge =
      (kTreeHeader + s.tree.surfaces.size() * kTreeSurface + s.tree.noise.size() * kTreeNoise) /
          kTreeWord +
      11 * s.tree.cells.size();
  EXPECT_TRUE(
      says(refusal(with_word(tree_bytes(s.tree), first_merge + 2 * 9 + 1, std::int64_t{1} << 30)),
           "vertices"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.merge_tree.merges[9] = t.merge_tree.merges[8]; }),
                   "forest"));
  EXPECT_TRUE(says(
      damaged([](SceneTree& t) { std::swap(t.merge_tree.merges[9], t.merge_tree.merges.back()); }),
      "forest"));
  // A tree with more coordinates than points that have a vertex cannot be written either.
  std::string bytes = tree_bytes(s.tree);
  const std::size_t first_point = (first_merge + 2 * s.tree.merge_tree.merges.size()) * kTreeWord;
  std::memcpy(
      &bytes[first_point + sizeof kTreeNoVertex * static_cast<std::size_t>(s.tree.points[0])],
      &kTreeNoVertex, sizeof kTreeNoVertex);
  EXPECT_TRUE(says(refusal(with_right_sum(bytes)), "points with a vertex"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.xyz[0] = test::kHole; }), "coordinate"));
  // Moves a point far from its voxel: high above the plane, behind the plane, or to the side.
  const Vec3 n = s.tree.plane->normal;
  for (const double away : {1.0, -1.0, 1e30})
    EXPECT_TRUE(says(damaged([&](SceneTree& t) {
                       for (std::size_t k = 0; k < 3; ++k)
                         t.xyz[k] += static_cast<float>(away * n[k]);
                     }),
                     "coordinates"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) { t.xyz[0] += 0.6F; }), "coordinates"));
  SceneTree pieces = segment(CloudView{stack().xyz(), {}}, {.method = Method::supervoxels}).tree;
  // The point is too far from its voxel to be in the base of an object, and this method does not
  // look through openings.
  pieces.xyz[0] += 0.05F;
  EXPECT_TRUE(says(refusal(tree_bytes(pieces)), "coordinates"));
  EXPECT_TRUE(says(damaged([](SceneTree& t) {
                     // Moves all points of the first voxel to another voxel.
                     for (std::uint32_t& v : t.vertex_of_point)
                       if (v == 0) v = static_cast<std::uint32_t>(t.cells.size() - 1);
                   }),
                   "coordinates"));
}

/// Two vessels whose bottoms appear 3 cm below the table, and the points that were restored through
/// their openings.
struct Bottoms {
  test::VesselScene scene{{{.x = -0.15}, {.x = 0.15, .radius = 0.06, .height = 0.05}}, 0.03};
  Segmentation s = segment(scene.cloud());
  std::vector<std::size_t> won_back;  // indices of s.points

  Bottoms() {
    for (std::size_t k = 0; k < s.tree.points.size(); ++k)
      if (scene.met()[static_cast<std::size_t>(s.tree.points[k])] == test::Met::bottom)
        won_back.push_back(k);
  }
  double height(std::size_t k) const {
    return s.tree.plane->signed_distance(s.tree.xyz[3 * k], s.tree.xyz[3 * k + 1],
                                         s.tree.xyz[3 * k + 2]);
  }
};

TEST(StoredTreeOpenings, BottomsBelowTheTableAreReadAgain) {
  const Bottoms b;
  EXPECT_GT(b.won_back.size(), 300U);
  for (const std::size_t k : b.won_back) EXPECT_LT(b.height(k), -0.025);
  const std::string bytes = tree_bytes(b.s.tree);
  const SceneTree again = read_again(bytes);
  EXPECT_EQ(tree_bytes(again), bytes);
  EXPECT_EQ(again.points, b.s.tree.points);
  expect_same(cut(again, again.first_cut), b.s.cut);
}

TEST(StoredTreeOpenings, WhatNoOpeningShowsIsRefused) {
  const Bottoms b;
  ASSERT_FALSE(b.won_back.empty());
  const std::size_t k = b.won_back[b.won_back.size() / 2];
  const Vec3 up = b.s.tree.plane->normal;
  const auto moved = [&](double x, double to_height) {
    SceneTree tree = b.s.tree;
    tree.xyz[3 * k] += static_cast<float>(x);
    for (std::size_t i = 0; i < 3; ++i)
      tree.xyz[3 * k + i] += static_cast<float>((to_height - b.height(k)) * up[i]);
    return tree_bytes(tree);
  };
  const auto is_refused = [&](double x, double to_height) {
    return refusal(moved(x, to_height)).find("seen through an opening") != std::string::npos;
  };
  const auto v = static_cast<Index>(b.s.tree.vertex_of_point[k]);
  const double of_voxel = b.s.tree.plane->signed_distance(
      b.s.tree.vertices(v, 0), b.s.tree.vertices(v, 1), b.s.tree.vertices(v, 2));
  for (const double height : {-0.049, 0.0, 0.9 * of_voxel})
    EXPECT_NO_THROW(read_again(moved(0, height))) << height;
  for (const double height : {-0.051, -1.0, 0.1, 1e30}) EXPECT_TRUE(is_refused(0, height));
  EXPECT_NO_THROW(read_again(moved(0.4, -0.03)));
  for (const double aside : {0.6, -0.6, 1e30}) EXPECT_TRUE(is_refused(aside, -0.03)) << aside;
  // Other methods do not look through openings. If no plane was found, no point can be below it.
  SceneTree tree = b.s.tree;
  tree.method = Method::supervoxels;
  EXPECT_NE(refusal(tree_bytes(tree)).find("seen through an opening"), std::string::npos);
  tree = b.s.tree;
  tree.plane.reset();
  tree.surfaces.clear();
  tree.noise.clear();
  tree.removed = 0;
  tree.removed_with.assign(tree.removed_with.size(), 0);
  EXPECT_NE(refusal(tree_bytes(tree)).find("seen through an opening"), std::string::npos);
}

// ---- real frames

TEST(StoredTreeScenes, CutsOfFramesAreTheirSegmentsAndTakeMilliseconds) {
  const fs::path folder = ph::test::test_data("scenes");
  if (folder.empty()) GTEST_SKIP() << ph::test::no_test_data("scenes");
  using Clock = std::chrono::steady_clock;
  const auto milliseconds = [](Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
  };
  double cutting = 0, worst = 0, reading = 0, bytes_of_all = 0;
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".pcd") continue;
    SCOPED_TRACE(entry.path().filename());
    const Cloud cloud = read_cloud(entry.path());
    for (const Method method : {Method::surface, Method::paper}) {
      const Segmentation s = segment(cloud, {.method = method, .check = false});
      const std::string bytes = tree_bytes(s.tree);
      const auto start = Clock::now();
      const SceneTree again = read_again(bytes);
      const auto middle = Clock::now();
      const SceneCut found = cut(again, again.first_cut);
      const double took = milliseconds(Clock::now() - middle);
      expect_same(found, s.cut);
      if (method == Method::paper) continue;
      ++frames;
      reading += milliseconds(middle - start);
      cutting += took;
      worst = std::max(worst, took);
      bytes_of_all += static_cast<double>(bytes.size());
    }
  }
  std::cout << frames << " frames: a cut takes " << cutting / frames << " ms, at most " << worst
            << " ms; a tree has " << bytes_of_all / frames / 1e6 << " MB and is read in "
            << reading / frames << " ms\n";
  EXPECT_LT(cutting / frames, 100);
}

}  // namespace
}  // namespace ph::segment
