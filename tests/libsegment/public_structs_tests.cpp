// SPDX-License-Identifier: MIT
// Structs that a user of the library fills in are checked like files.
#include <gtest/gtest.h>

#include <functional>

#include "ph/label_tracker.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::segment {
namespace {

using ph::test::expect_error;
using test::TableScene;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Index kMost = std::numeric_limits<Index>::max();

TEST(PublicStructs, SegmentOptions) {
  const std::vector<float> xyz = {0, 0, 1, 0, 0.1F, 1, 0.1F, 0, 1};
  struct Wrong {
    const char* part;
    SegmentOptions options;
  };
  const Wrong wrongs[] = {
      {"voxel: found nan", {.voxel = kNan}},
      {"voxel: found 0", {.voxel = 0}},
      {"voxel: found -1", {.voxel = -1}},
      {"voxel: found inf", {.voxel = kInfinity}},
      {"min_size: found 0", {.min_size = 0}},
      {"max_range: found nan", {.max_range = kNan}},
      {"max_range: found -1", {.max_range = -1}},
      {"crop: found 1", {.crop = Box{{1, 0, 0}, {0, 1, 1}}}},
      {"crop: found nan", {.crop = Box{{0, kNan, 0}, {1, 1, 1}}}},
      {"crop: found 0", {.crop = Box{{0, 0, 0}, {1, 1, kNan}}}},
      {"plane_distance: found nan", {.plane_distance = kNan}},
      {"plane_distance: found 0", {.plane_distance = 0}},
      {"plane_noise: found nan", {.plane_noise = kNan}},
      {"plane_noise: found inf", {.plane_noise = kInfinity}},
      {"viewpoint: found nan", {.viewpoint = Vec3{0, kNan, 0}}},
      {"viewpoint: found inf", {.viewpoint = Vec3{0, 0, kInfinity}}},
      {"min_persistence: found nan", {.min_persistence = kNan}},
      {"min_persistence: found -1", {.min_persistence = -1}},
      {"min_part: found 0", {.min_part = 0}},
      {"spacing: found nan", {.method = Method::supervoxels, .spacing = kNan}},
      {"spacing: found 0.001", {.method = Method::supervoxels, .spacing = 0.001}},
      {"distance: found nan", {.method = Method::paper, .distance = kNan}},
      {"distance: found inf", {.method = Method::paper, .distance = kInfinity}},
      {"steps: found -1", {.method = Method::paper, .steps = -1}},
  };
  for (const Wrong& wrong : wrongs)
    expect_error(ErrorKind::usage, wrong.part, [&] { segment(CloudView{xyz, {}}, wrong.options); });
}

TEST(PublicStructs, Clouds) {
  const std::vector<float> xyz(12, 1);
  const auto view = [&](Index width, Index height, std::size_t numbers = 12) {
    return [&xyz, width, height, numbers] {
      segment(CloudView{std::span(xyz).first(numbers), {}, width, height});
    };
  };
  expect_error(ErrorKind::bad_data, "found 11 coordinates", view(0, 1, 11));
  expect_error(ErrorKind::bad_data, "found 4 points", view(3, 1));
  expect_error(ErrorKind::bad_data, "found 4 points", view(-4, -1));
  expect_error(ErrorKind::bad_data, "found 4 points", view(2, kMost));
  expect_error(ErrorKind::bad_data, "found 4 points", view(kMost, kMost));
  Cloud cloud = test::cloud_of(xyz, 2, 2);
  cloud.data.resize(47);
  expect_error(ErrorKind::bad_data, "found 47 bytes", [&] { segment(cloud); });
  expect_error(ErrorKind::bad_data, "found 47 bytes",
               [&] { with_labels(cloud, std::vector<std::uint32_t>(4)); });
  cloud.width = cloud.height = kMost;
  expect_error(ErrorKind::bad_data, "found 47 bytes",
               [&] { with_labels(cloud, std::vector<std::uint32_t>(1)); });
}

/// All arrays of a scene and of its cut are validated. The test shortens each array and makes each
/// number invalid.
TEST(PublicStructs, ScenesAndCuts) {
  const Segmentation right = segment(CloudView{TableScene::two_boxes().xyz(), {}});
  ASSERT_EQ(right.cut.segments.size(), 2U);
  const std::function<void(Segmentation&)> scene_faults[] = {
      [](auto& s) { s.tree.points.pop_back(); },
      [](auto& s) { std::swap(s.tree.points[0], s.tree.points[1]); },
      [](auto& s) { s.tree.points.back() = s.tree.width * s.tree.height; },
      [](auto& s) { s.tree.points.front() = -1; },
      [](auto& s) { s.tree.vertex_of_point.pop_back(); },
      [](auto& s) {
        s.tree.vertex_of_point.back() = static_cast<std::uint32_t>(s.tree.cells.size());
      },
      [](auto& s) { s.tree.xyz.pop_back(); },
      [](auto& s) { s.tree.cells.pop_back(); },
      [](auto& s) { s.tree.vertices.keep_rows(s.tree.vertices.rows() - 1); },
      [](auto& s) { s.tree.normals = Points(0, 3); },
      [](auto& s) { s.tree.counts.pop_back(); },
      [](auto& s) { s.tree.merge_tree.births.pop_back(); },
      [](auto& s) { s.tree.merge_tree.merges.back().u = -1; },
      [](auto& s) { s.tree.merge_tree.merges.back().younger = s.tree.vertices.rows(); },
      [](auto& s) { s.tree.width = s.tree.height = kMost; },
      [](auto& s) { s.tree.width = -1; },
  };
  int number = 0;
  for (const auto& spoil : scene_faults) {
    SCOPED_TRACE(number++);
    Segmentation wrong = right;
    spoil(wrong);
    LabelTracker tracker;
    const std::uint32_t label = 1;
    expect_error(ErrorKind::bad_data, "scene: ", [&] { cut(wrong.tree, wrong.tree.first_cut); });
    expect_error(ErrorKind::bad_data, "scene: ", [&] { tree_bytes(wrong.tree); });
    expect_error(ErrorKind::bad_data, "scene: ", [&] { tree_json(wrong.tree); });
    expect_error(ErrorKind::bad_data, "scene: ", [&] { first_meeting(wrong, 1, 2); });
    expect_error(ErrorKind::bad_data, "scene: ", [&] {
      signature(wrong.tree, wrong.cut, {&label, 1});
    });
    expect_error(ErrorKind::bad_data, "scene: ", [&] { tracker.update(wrong.tree, wrong.cut); });
  }
  const std::function<void(Segmentation&)> cut_faults[] = {
      [](auto& s) { s.cut.labels.pop_back(); },
      [](auto& s) { s.cut.vertex_labels.pop_back(); },
      [](auto& s) { s.cut.labels.back() = 3; },
      [](auto& s) { s.cut.vertex_labels.front() = 3; },
      [](auto& s) { s.cut.surface_labels.front() = 2; },
      [](auto& s) {
        s.cut.segments.front().on = {2, 0};
      },
      [](auto& s) {
        s.cut.segments.front().on = {0, 3};
      },
  };
  for (const auto& spoil : cut_faults) {
    SCOPED_TRACE(number++);
    Segmentation wrong = right;
    spoil(wrong);
    LabelTracker tracker;
    const std::uint32_t label = 1;
    expect_error(ErrorKind::bad_data, "cut: ", [&] { first_meeting(wrong, 1, 2); });
    expect_error(ErrorKind::bad_data, "cut: ", [&] {
      signature(wrong.tree, wrong.cut, {&label, 1});
    });
    expect_error(ErrorKind::bad_data, "cut: ", [&] { tracker.update(wrong.tree, wrong.cut); });
  }
  for (const double value : {kNan, -1.0})
    expect_error(ErrorKind::usage, "cut: found", [&] { cut(right.tree, {.value = value}); });
  expect_error(ErrorKind::usage, "min_part", [&] { cut(right.tree, {.min_part = 0}); });
  expect_error(ErrorKind::usage, "min_size", [&] { cut(right.tree, {.min_size = -1}); });
}

TEST(PublicStructs, Tracker) {
  expect_error(ErrorKind::usage, "patience: found -1", [] { LabelTracker(-1); });
  for (const double cell : {kNan, 0.0, -1.0, kInfinity})
    expect_error(ErrorKind::usage, "cell: found", [&] { LabelTracker(5, cell); });
}

}  // namespace
}  // namespace ph::segment
