// SPDX-License-Identifier: MIT
// Method paper on small scenes with known answers, and on empty inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ph/error.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::segment {
namespace {

using test::kHole;
using test::TableScene;

const SegmentOptions kPaper{.method = Method::paper};
const std::vector<std::string_view> kStages = {
    "range filter", "plane", "voxel grid", "complex", "persistence", "components", "check"};

TEST(Pipeline, TwoBoxesOnATable) {
  const TableScene scene = TableScene::two_boxes();
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, kPaper);
  ASSERT_TRUE(s.tree.plane) << s.plane_note;
  EXPECT_EQ(s.plane_note, "");
  EXPECT_TRUE(s.checked);
  EXPECT_EQ(s.difference, "");
  ASSERT_EQ(s.cut.segments.size(), 2U);
  ASSERT_EQ(s.cut.labels.size(), scene.truth().size());

  // Counts the points of each box that are above the plane by more than its thickness. Exactly
  // these points must be labelled.
  std::array<Index, 3> points{};
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
    const float* p = &scene.xyz()[3 * i];
    const bool out =
        scene.truth()[i] > 0 && s.tree.plane->signed_distance(p[0], p[1], p[2]) > 0.006;
    EXPECT_EQ(s.cut.labels[i], out ? static_cast<std::uint32_t>(scene.truth()[i]) : 0) << i;
    ++points[s.cut.labels[i]];
  }
  EXPECT_EQ(points[1], s.cut.segments[0].points);
  EXPECT_EQ(points[2], s.cut.segments[1].points);
  EXPECT_GT(points[1], points[2]);
  EXPECT_GT(points[2], 300);
  EXPECT_LT(s.cut.segments[0].centroid[0], -0.1);
  EXPECT_GT(s.cut.segments[1].centroid[0], 0.1);
  EXPECT_TRUE(std::isinf(s.cut.segments[0].persistence));

  // The plane must be the table, which is tilted by 45 degrees and one metre away.
  EXPECT_NEAR(s.tree.plane->normal[1], -std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(s.tree.plane->offset, std::sqrt(0.5), 1e-3);
}

TEST(Pipeline, StagesAndComplex) {
  const TableScene scene = TableScene::two_boxes();
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, kPaper);
  ASSERT_EQ(s.stages.size(), kStages.size());
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    EXPECT_EQ(s.stages[i].name, kStages[i]);
    EXPECT_GE(s.stages[i].seconds, 0);
  }
  EXPECT_EQ(s.stages[0].points, std::ranges::count_if(scene.truth(), [](int t) { return t >= 0; }));
  EXPECT_EQ(s.stages[2].points, s.tree.vertices.rows());
  EXPECT_EQ(s.stages[5].points, s.cut.segments[0].voxels + s.cut.segments[1].voxels);
  EXPECT_EQ(static_cast<Index>(s.barcode.size()), s.tree.vertices.rows());
  EXPECT_EQ(s.tree.merge_tree.size(), s.tree.vertices.rows());
  EXPECT_GT(s.tree.edges, s.tree.vertices.rows());
  // Checks that every death is one of the ten levels.
  for (const Bar& bar : s.barcode) {
    if (bar.is_infinite()) continue;
    const double level = bar.death / 0.025 * 10;
    EXPECT_NEAR(level, std::round(level), 1e-9);
  }
}

TEST(Pipeline, BoxesThatNearlyTouchAreOneSegmentBeyondTheirGap) {
  // The boxes are 40 mm apart. They are separate at 25 mm and joined at 60 mm.
  const TableScene scene(
      {{{-0.12, -0.05, 0}, {-0.02, 0.05, 0.1}}, {{0.02, -0.05, 0}, {0.12, 0.05, 0.1}}});
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}, kPaper).cut.segments.size(), 2U);
  EXPECT_EQ(segment(CloudView{scene.xyz(), {}}, {.method = Method::paper, .distance = 0.06})
                .cut.segments.size(),
            1U);
}

TEST(Pipeline, StepsChangeTheBarcodeButNotTheSegments) {
  const TableScene scene = TableScene::two_boxes();
  const Segmentation ten = segment(CloudView{scene.xyz(), {}}, kPaper);
  const Segmentation exact =
      segment(CloudView{scene.xyz(), {}}, {.method = Method::paper, .steps = 0});
  EXPECT_EQ(ten.cut.labels, exact.cut.labels);
  ASSERT_EQ(ten.barcode.size(), exact.barcode.size());
  EXPECT_EQ(ten.tree.edges, exact.tree.edges);
  for (std::size_t i = 0; i < ten.barcode.size(); ++i) {
    EXPECT_GE(ten.barcode[i].death, exact.barcode[i].death);
    if (!ten.barcode[i].is_infinite()) {
      EXPECT_LE(ten.barcode[i].death, exact.barcode[i].death + 0.0025 + 1e-12);
    }
  }
}

TEST(Pipeline, EverythingPlane) {
  const TableScene scene(std::vector<test::Block>{});
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, kPaper);
  ASSERT_TRUE(s.tree.plane);
  EXPECT_DOUBLE_EQ(s.tree.plane->share, 1);
  EXPECT_TRUE(s.cut.segments.empty());
  EXPECT_EQ(std::ranges::count(s.cut.labels, 0U), static_cast<Index>(s.cut.labels.size()));
  EXPECT_EQ(s.tree.vertices.rows(), 0);
  EXPECT_TRUE(s.barcode.empty());
  EXPECT_TRUE(s.checked);
}

TEST(Pipeline, WithoutThePlaneTheTableIsASegment) {
  const TableScene scene = TableScene::two_boxes();
  const Segmentation s =
      segment(CloudView{scene.xyz(), {}}, {.method = Method::paper, .plane = false});
  EXPECT_FALSE(s.tree.plane);
  EXPECT_NE(s.plane_note, "");
  ASSERT_EQ(s.stages.size(), kStages.size() - 1);
  ASSERT_FALSE(s.cut.segments.empty());
  EXPECT_GT(s.cut.segments[0].points, 8000);
}

TEST(Pipeline, NothingInIt) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{12}}) {
    const std::vector<float> holes(3 * n, kHole);
    const Segmentation s = segment(CloudView{holes, {}}, kPaper);
    EXPECT_EQ(s.cut.labels, std::vector<std::uint32_t>(n));
    EXPECT_TRUE(s.cut.segments.empty());
    EXPECT_FALSE(s.tree.plane);
    EXPECT_NE(s.plane_note, "");
    EXPECT_EQ(s.difference, "");
  }
}

TEST(Pipeline, OneValidPixel) {
  std::vector<float> xyz(3 * 12, kHole);
  xyz[9] = xyz[10] = 0;
  xyz[11] = 1;
  EXPECT_TRUE(segment(CloudView{xyz, {}}, kPaper).cut.segments.empty());
  const Segmentation s = segment(CloudView{xyz, {}}, {.method = Method::paper, .min_size = 1});
  ASSERT_EQ(s.cut.segments.size(), 1U);
  EXPECT_EQ(s.cut.segments[0].points, 1);
  EXPECT_EQ(s.cut.labels[3], 1U);
  EXPECT_EQ(s.cut.segments[0].centroid, (Vec3{0, 0, 1}));
  ASSERT_EQ(s.barcode.size(), 1U);
  EXPECT_TRUE(s.barcode[0].is_infinite());
}

TEST(Pipeline, TooFarAwayIsNothing) {
  const TableScene scene = TableScene::two_boxes();
  const Segmentation s =
      segment(CloudView{scene.xyz(), {}}, {.method = Method::paper, .max_range = 0.1});
  EXPECT_EQ(s.stages[0].points, 0);
  EXPECT_TRUE(s.cut.segments.empty());
}

TEST(Pipeline, CropLeavesOneBox) {
  const TableScene scene = TableScene::two_boxes();
  const SegmentOptions left{.method = Method::paper, .crop = Box{{-1, -1, 0}, {0, 1, 2}}};
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, left);
  ASSERT_EQ(s.cut.segments.size(), 1U);
  EXPECT_LT(s.cut.segments[0].centroid[0], 0);
}

TEST(Pipeline, TheViewpointDecidesWhichSideIsKept) {
  const TableScene scene = TableScene::two_boxes();
  Cloud cloud = scene.cloud();
  EXPECT_EQ(segment(cloud, kPaper).cut.segments.size(), 2U);
  cloud.viewpoint[2] = 2.5;  // a viewpoint below the table
  const Segmentation told = segment(cloud, {.method = Method::paper, .max_range = 5});
  EXPECT_EQ(told.cut.segments.size(), 2U) << "the rays of the pixels tell better";
  EXPECT_TRUE(told.rays_meet_at);
  EXPECT_LT(told.plane_sight.behind, 0.1);
  cloud.width = cloud.size();
  cloud.height = 1;  // without rows, there are no rays
  const Segmentation below = segment(cloud, {.method = Method::paper, .max_range = 5});
  EXPECT_EQ(below.cut.segments.size(), 0U);
  EXPECT_FALSE(below.rays_meet_at);
  EXPECT_GT(below.plane_sight.behind, 0.9);
  EXPECT_GT(below.plane_sight.hidden, 0.1);
  EXPECT_EQ(
      segment(cloud, {.method = Method::paper, .viewpoint = Vec3{0, 0, 0}}).cut.segments.size(),
      2U);
}

// If there are other numbers between the coordinates, the coordinates are read in place.
TEST(Pipeline, AnyStride) {
  const TableScene scene = TableScene::two_boxes();
  const std::vector<float>& xyz = scene.xyz();
  const auto expected = segment(CloudView{xyz, {}, TableScene::kWidth, TableScene::kHeight});
  for (const std::size_t stride : {4U, 7U}) {
    std::vector<float> wide(xyz.size() / 3 * stride, 0.75F);
    for (std::size_t i = 0; i < xyz.size(); ++i) wide[i / 3 * stride + i % 3] = xyz[i];
    const auto last = wide.size() - stride + 3;
    CloudView cloud{std::span(wide).first(last), {}, TableScene::kWidth, TableScene::kHeight};
    cloud.stride = stride;
    EXPECT_EQ(segment(cloud).cut.labels, expected.cut.labels) << stride;
    cloud.xyz = wide;  // numbers after the last z are not part of the cloud
    ph::test::expect_error(ErrorKind::bad_data, "floats, expected", [&] { segment(cloud); });
  }
  CloudView cloud{xyz, {}};
  cloud.stride = 2;
  ph::test::expect_error(ErrorKind::bad_data, "found a stride of 2", [&] { segment(cloud); });
}

TEST(Pipeline, OptionsOutOfRange) {
  const std::vector<float> xyz = {0, 0, 1};
  const CloudView cloud{xyz, {}};
  const double nan = std::nan("");
  const auto expect_usage = [&](const SegmentOptions& options) {
    EXPECT_TRUE(ph::test::fails_with(ErrorKind::usage, [&] { segment(cloud, options); }));
  };
  for (const double bad : {0.0, -1.0, nan, kInfinity}) {
    expect_usage({.voxel = bad});
    expect_usage({.plane_distance = bad});
  }
  for (const double bad : {-1.0, nan, kInfinity}) expect_usage({.distance = bad});
  expect_usage({.min_persistence = -1});
  expect_usage({.min_persistence = nan});
  expect_usage({.min_part = 0});
  expect_usage({.steps = -1});
  for (const double bad : {-1.0, nan, kInfinity}) expect_usage({.plane_noise = bad});
  for (const double bad : {0.0, 0.001, nan, kInfinity})
    expect_usage({.method = Method::supervoxels, .spacing = bad});
  expect_usage({.min_size = 0});
  expect_usage({.max_range = nan});
  expect_usage({.crop = Box{{1, 0, 0}, {0, 1, 1}}});
  expect_usage({.viewpoint = Vec3{nan, 0, 0}});
  EXPECT_THROW(segment(CloudView{{xyz.data(), 2}, {}}), Error);
}

TEST(Pipeline, PlainArraysKeepTheirRowsAndColumns) {
  const TableScene scene = TableScene::two_boxes();
  const CloudView cloud{scene.xyz(), {}, scene.kWidth, scene.kHeight};
  for (const Method method : {Method::surface, Method::paper}) {
    const Segmentation s = segment(cloud, {.method = method});
    EXPECT_EQ(s.tree.width, scene.kWidth);
    EXPECT_EQ(s.tree.height, scene.kHeight);
    EXPECT_EQ(s.cut.labels, segment(scene.cloud(), {.method = method}).cut.labels);
    const Segmentation row = segment(CloudView{scene.xyz(), {}}, {.method = method});
    EXPECT_EQ(row.tree.width, scene.kWidth * scene.kHeight);
    EXPECT_EQ(row.tree.height, 1);
  }
  const std::pair<Index, Index> wrong[] = {
      {320, 239}, {321, 240}, {-320, -240}, {Index{1} << 62, 4}, {320, 0}};
  for (const auto& [width, height] : wrong) {
    EXPECT_TRUE(ph::test::fails_with(ErrorKind::bad_data,
                                     [&] {
                                       segment(CloudView{scene.xyz(), {}, width, height});
                                     }))
        << width << " x " << height;
  }
}

TEST(Pipeline, ColumnsWithoutRowsAreATreeThatIsReadAgain) {
  const std::pair<Index, Index> sizes[] = {{5, 0}, {0, 5}, {0, 0}};
  for (const auto& [width, height] : sizes) {
    const Segmentation s = segment(CloudView{{}, {}, width, height});
    EXPECT_EQ(s.tree.width * s.tree.height, 0);
    const SceneTree again = read_tree(Input::view(tree_bytes(s.tree), "s.tree"));
    EXPECT_EQ(again.width, s.tree.width);
    EXPECT_EQ(again.height, 1);
  }
}

TEST(Pipeline, WhatIsHeldCountsInTheBudget) {
  const TableScene scene = TableScene::two_boxes();
  const std::size_t points = scene.truth().size();
  for (const Method method : {Method::surface, Method::paper, Method::supervoxels}) {
    RunContext context;
    const Segmentation s = segment(CloudView{scene.xyz(), {}}, {.method = method}, context);
    const auto voxels = static_cast<std::size_t>(s.tree.vertices.rows());
    EXPECT_GT(context.memory.peak(), 52 * points + 400 * voxels);
    EXPECT_EQ(context.memory.used(), 0U);
    ph::test::LimitedContext less(context.memory.peak() - 1);
    EXPECT_THROW(segment(CloudView{scene.xyz(), {}}, {.method = method}, less), Error);
  }
}

TEST(Pipeline, StopsWhenAsked) {
  const TableScene scene = TableScene::two_boxes();
  ph::test::StoppedContext context;
  EXPECT_TRUE(ph::test::fails_with(ErrorKind::cancelled, [&] {
    segment(CloudView{scene.xyz(), {}}, kPaper, context);
  })) << "did not stop";
}

}  // namespace
}  // namespace ph::segment
