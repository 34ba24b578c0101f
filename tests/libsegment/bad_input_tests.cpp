// SPDX-License-Identifier: MIT
// Input that is empty, or that is not what the user meant. Tests the statements of
// docs/explanation/segmentation.md about such input, with all methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using test::kHole;
using test::TableScene;

class BadInput : public testing::TestWithParam<Method> {
 protected:
  Segmentation segmented(const std::vector<float>& xyz, SegmentOptions options = {}) const {
    options.method = GetParam();
    const Segmentation s = segment(CloudView{xyz, {}}, options);
    EXPECT_EQ(s.cut.labels.size(), xyz.size() / 3);
    EXPECT_EQ(s.difference, "");
    const SceneTree again = read_tree(Input::view(tree_bytes(s.tree), "s.tree"));
    EXPECT_EQ(cut(again, again.first_cut).labels, s.cut.labels);
    return s;
  }
  /// Checks that there are as many segments as objects. With method supervoxels, there may be more
  /// segments, because they are pieces of objects.
  void expect_objects(const Segmentation& s, std::size_t objects) const {
    if (GetParam() == Method::supervoxels && objects > 0)
      EXPECT_GT(s.cut.segments.size(), objects);
    else
      EXPECT_EQ(s.cut.segments.size(), objects);
  }
  /// The number of segments expected from a few isolated voxels. With method supervoxels, they form
  /// one segment. For the other methods, they are too few.
  std::size_t a_crumb() const { return GetParam() == Method::supervoxels ? 1 : 0; }
};
INSTANTIATE_TEST_SUITE_P(Methods, BadInput,
                         testing::Values(Method::surface, Method::paper, Method::supervoxels),
                         [](const auto& method) {
                           return std::string(test::name_of(method.param));
                         });

std::vector<float> scaled(std::vector<float> xyz, double factor) {
  for (float& x : xyz) x = static_cast<float>(x * factor);
  return xyz;
}

/// Points on the visible part of a sphere, without anything behind its outline.
std::vector<float> ball(double radius, int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<float> xyz;
  while (xyz.size() < 3 * static_cast<std::size_t>(count)) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const double r = radius / std::hypot(x, y, z);
    if (std::abs(z) * r < radius * radius) continue;
    for (const double c : {x * r, y * r, 1 - std::abs(z) * r}) xyz.push_back(static_cast<float>(c));
  }
  return xyz;
}

TEST_P(BadInput, NothingOrOnlyHoles) {
  for (const std::size_t n : {0U, 1U, 10000U}) {
    const Segmentation s = segmented(std::vector<float>(3 * n, kHole));
    EXPECT_TRUE(s.cut.segments.empty());
    EXPECT_FALSE(s.tree.plane);
    EXPECT_NE(s.plane_note, "");
  }
}

TEST_P(BadInput, OnePixel) {
  std::vector<float> xyz(3 * 10000, kHole);
  xyz[0] = xyz[1] = 0, xyz[2] = 1;
  EXPECT_EQ(segmented(xyz).cut.segments.size(), a_crumb());
  const Segmentation s = segmented(xyz, {.min_size = 1});
  ASSERT_EQ(s.cut.segments.size(), 1U);
  EXPECT_EQ(s.cut.segments[0].oriented_box.size, (Vec3{0, 0, 0}));
  EXPECT_EQ(s.cut.labels[0], 1U);
}

TEST_P(BadInput, OnlyAPlane) {
  const Segmentation s = segmented(TableScene({}).xyz());
  EXPECT_TRUE(s.tree.plane);
  EXPECT_TRUE(s.cut.segments.empty());
}

TEST_P(BadInput, NoPlane) {
  const Segmentation s = segmented(ball(0.3, 40000));
  EXPECT_FALSE(s.tree.plane);
  EXPECT_NE(s.plane_note, "");
  expect_objects(s, 1);  // nothing is removed, and the ball is in one piece
  Index points = 0;
  for (const Segment& g : s.cut.segments) points += g.points;
  EXPECT_GT(points, 39000);
}

TEST_P(BadInput, SeveralPlanes) {
  // A shelf hangs above the table. The plane with the most points is removed, and the other plane
  // is a segment. The points of the shelf are so dense that their voxels touch.
  const TableScene scene({{{-0.5, 0.2, 0.0}, {0.5, 0.45, 0.15}}, {{-0.1, -0.2, 0}, {0, -0.1, 0.1}}},
                         2);
  const Segmentation s = segmented(scene.xyz());
  ASSERT_TRUE(s.tree.plane);
  EXPECT_NEAR(s.tree.plane->offset, std::sqrt(0.5), 0.01) << "the table";
  expect_objects(s, 2);
  double left = kInfinity, right = -kInfinity;
  for (const Segment& g : s.cut.segments) {
    left = std::min(left, g.box.min[0]);
    right = std::max(right, g.box.max[0]);
  }
  EXPECT_GT(right - left, 0.9) << "the shelf";
  if (GetParam() != Method::supervoxels) {
    EXPECT_GT(s.cut.segments[0].oriented_box.size[0], 0.9);
  }
}

TEST_P(BadInput, UnorganisedIsTheSame) {
  const std::vector<float> xyz = TableScene::two_boxes().xyz();
  const Segmentation s = segmented(xyz);
  std::vector<float> dense;
  std::vector<std::uint32_t> labels;
  for (std::size_t i = s.cut.labels.size(); i-- > 0;) {
    if (std::isnan(xyz[3 * i])) continue;
    dense.insert(dense.end(), {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    labels.push_back(s.cut.labels[i]);
  }
  EXPECT_EQ(segmented(dense).cut.labels, labels);
}

TEST_P(BadInput, TenMegapixels) {
  const TableScene scene(
      {{{-0.22, -0.05, 0}, {-0.10, 0.07, 0.12}}, {{0.10, -0.05, 0}, {0.2, 0.05, 0.1}}}, 11.5);
  ASSERT_GT(scene.truth().size(), 10000000U);
  SegmentOptions options;
  options.method = GetParam();
  const auto start = std::chrono::steady_clock::now();
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  expect_objects(s, 2);
  EXPECT_LT(took.count(), 60);
  std::cout << scene.truth().size() << " points in " << took.count() << " s\n";
}

TEST_P(BadInput, MillimetresForMetresLeaveNothingInRange) {
  const Segmentation s = segmented(scaled(TableScene::two_boxes().xyz(), 1000));
  EXPECT_EQ(s.stages[0].points, 0);
  EXPECT_TRUE(s.cut.segments.empty());
}

TEST_P(BadInput, MetresForMillimetresAreACrumb) {
  EXPECT_EQ(segmented(scaled(TableScene::two_boxes().xyz(), 0.001)).cut.segments.size(), a_crumb());
}

TEST_P(BadInput, AbsurdFocalLengths) {
  const std::vector<float> xyz = TableScene::two_boxes().xyz();
  // Scales x and y, as if the focal length were wrong.
  for (const double factor : {1e-9, 1e-3, 50.0, 1e3, 1e9}) {
    std::vector<float> stretched = xyz;
    for (std::size_t i = 0; i < stretched.size(); ++i)
      if (i % 3 != 2) stretched[i] = static_cast<float>(stretched[i] * factor);
    segmented(stretched);
  }
}

TEST_P(BadInput, NoiseInAllOfSpaceTakesBoundedTime) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  std::vector<float> xyz;
  for (int i = 0; i < 300000; ++i)
    xyz.insert(xyz.end(), {unit(random), unit(random), 1 + unit(random)});
  const auto start = std::chrono::steady_clock::now();
  SegmentOptions options{.check = false};
  options.method = GetParam();
  segment(CloudView{xyz, {}}, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::cout << "300000 points in all of space in " << took.count() << " s\n";
  EXPECT_LT(took.count(), 60);
}

}  // namespace
}  // namespace ph::segment
