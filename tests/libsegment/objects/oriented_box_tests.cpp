// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/oriented_box.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using Eigen::Vector3d;
using test::TableScene;

Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// A coordinate frame that is rotated about all axes.
Eigen::Matrix3d turned() {
  return (Eigen::AngleAxisd(0.7, Vector3d::UnitX()) * Eigen::AngleAxisd(-0.4, Vector3d::UnitY()) *
          Eigen::AngleAxisd(1.1, Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// The corners of a box and random points in it, in a rotated frame.
std::vector<float> box_points(const Eigen::Matrix3d& frame, const Vector3d& size, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  std::vector<float> xyz;
  const auto add = [&](const Vector3d& place) {
    const Vector3d p = frame * place.cwiseProduct(size) + Vector3d(0.1, -0.2, 0.9);
    for (Index k = 0; k < 3; ++k) xyz.push_back(static_cast<float>(p[k]));
  };
  for (int i = 0; i < 8; ++i) add({i & 1 ? .5 : -.5, i & 2 ? .5 : -.5, i & 4 ? .5 : -.5});
  for (int i = 0; i < count; ++i) add({unit(random), unit(random), unit(random)});
  return xyz;
}

Vec3 column(const Eigen::Matrix3d& frame, Index k) {
  return {frame(0, k), frame(1, k), frame(2, k)};
}

/// The x, y and z coordinates in separate arrays, which the functions for boxes expect.
struct Apart {
  explicit Apart(const std::vector<float>& xyz) {
    for (std::size_t i = 0; i < xyz.size(); ++i) coordinates[i % 3].push_back(xyz[i]);
  }
  operator Coordinates() const { return {coordinates[0], coordinates[1], coordinates[2]}; }
  std::array<std::vector<float>, 3> coordinates;
};

void expect_frame(const OrientedBox& box) {
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      EXPECT_NEAR(vector(box.axes[a]).dot(vector(box.axes[b])), a == b, 1e-12);
  EXPECT_NEAR(vector(box.axes[0]).cross(vector(box.axes[1])).dot(vector(box.axes[2])), 1, 1e-12);
}

TEST(OrientedBox, OfATurnedBoxOnAPlane) {
  const Eigen::Matrix3d frame = turned();
  for (const Vector3d& size : {Vector3d(0.3, 0.1, 0.2), Vector3d(0.05, 0.4, 0.01)}) {
    const std::vector<float> xyz = box_points(frame, size, 5000);
    const OrientedBox box = box_on_plane(Apart(xyz), column(frame, 2));
    expect_frame(box);
    EXPECT_NEAR(box.size[0], std::max(size[0], size[1]), 1e-6);
    EXPECT_NEAR(box.size[1], std::min(size[0], size[1]), 1e-6);
    EXPECT_NEAR(box.size[2], size[2], 1e-6);
    EXPECT_NEAR((vector(box.centre) - Vector3d(0.1, -0.2, 0.9)).norm(), 0, 1e-6);
    EXPECT_EQ(box.axes[2], column(frame, 2));
  }
}

TEST(OrientedBox, NoDirectionGivesASmallerRectangle) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int round = 0; round < 50; ++round) {
    std::vector<float> xyz;
    const int count = 1 + round * round;
    for (int i = 0; i < count; ++i)
      xyz.insert(xyz.end(), {3 * normal(random), normal(random), normal(random)});
    const OrientedBox box = box_on_plane(Apart(xyz), {0, 0, 1});
    expect_frame(box);
    for (int step = 0; step < 360; ++step) {
      const double angle = std::numbers::pi / 720 * step;
      const OrientedBox other =
          box_along(Apart(xyz), {Vec3{std::cos(angle), std::sin(angle), 0},
                                 Vec3{-std::sin(angle), std::cos(angle), 0}, Vec3{0, 0, 1}});
      ASSERT_LE(box.size[0] * box.size[1], other.size[0] * other.size[1] * (1 + 1e-9) + 1e-12);
    }
  }
}

TEST(OrientedBox, FewPoints) {
  const Vec3 up{0, 0, 1};
  const OrientedBox one = box_on_plane(Apart(std::vector<float>{1, 2, 3}), up);
  expect_frame(one);
  EXPECT_EQ(one.size, (Vec3{0, 0, 0}));
  EXPECT_NEAR(one.centre[1], 2, 1e-12);
  const OrientedBox line =
      box_on_plane(Apart(std::vector<float>{0, 0, 0, 3, 4, 1, 6, 8, 2, 0, 0, 0}), up);
  expect_frame(line);
  EXPECT_NEAR(line.size[0], 10, 1e-9);
  EXPECT_NEAR(line.size[1], 0, 1e-9);
  EXPECT_NEAR(line.size[2], 2, 1e-12);
  expect_frame(box_on_plane(Apart(std::vector<float>(300, 0.25F)), up));
  Points place{{1, 2, 3}};
  EXPECT_TRUE(std::isfinite(principal_axes(place, std::vector<double>{4}, {})[0][0]));
}

TEST(OrientedBox, NoPointIsOutside) {
  // Rings, lines and clusters. An octagon through some of the points contains many, few or none of
  // the other points, which are then left out.
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int round = 0; round < 200; ++round) {
    std::vector<float> xyz;
    for (int i = 0; i < 1 + round; ++i) {
      const float angle = 3 * uniform(random), a = round % 2 == 0 ? uniform(random) : 1.0F;
      xyz.insert(xyz.end(), {a * std::cos(angle), round % 3 == 0 ? 0.0F : a * std::sin(angle), a});
    }
    if (round % 5 == 0)
      for (int i = 0; i < 100; ++i) xyz.insert(xyz.end(), {0.5F, 0.0F, 0.0F});
    const OrientedBox box = box_on_plane(Apart(xyz), {0, 0, 1});
    expect_frame(box);
    Box around{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      const Vector3d p = Vector3d(xyz[i], xyz[i + 1], xyz[i + 2]);
      for (std::size_t k = 0; k < 3; ++k) {
        const double along = vector(box.axes[k]).dot(p - vector(box.centre));
        ASSERT_LE(std::abs(along), box.size[k] / 2 + 1e-9);
        around.min[k] = std::min(around.min[k], p[static_cast<Index>(k)]);
        around.max[k] = std::max(around.max[k], p[static_cast<Index>(k)]);
      }
    }
    ASSERT_EQ(box_around(Apart(xyz)), around);
  }
}

TEST(OrientedBox, OrderOfThePoints) {
  std::vector<float> xyz = box_points(turned(), {0.3, 0.1, 0.2}, 1000);
  const OrientedBox box = box_on_plane(Apart(xyz), column(turned(), 2));
  std::vector<float> reversed;
  for (std::size_t i = xyz.size(); i > 0; i -= 3)
    reversed.insert(reversed.end(), {xyz[i - 3], xyz[i - 2], xyz[i - 1]});
  EXPECT_EQ(box_on_plane(Apart(reversed), column(turned(), 2)), box);
}

TEST(OrientedBox, OfBoxesOnATable) {
  const double pixel = 0.006;  // the size of a pixel at this range
  const Segmentation s = segment(CloudView{TableScene::two_boxes().xyz(), {}});
  ASSERT_EQ(s.cut.segments.size(), 2U);
  const std::array<Vec3, 2> sizes = {Vec3{0.12, 0.12, 0.12}, Vec3{0.1, 0.1, 0.1}};
  for (std::size_t i = 0; i < 2; ++i) {
    const OrientedBox& box = s.cut.segments[i].oriented_box;
    expect_frame(box);
    EXPECT_EQ(box.axes[2], s.tree.plane->normal);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(box.size[k], sizes[i][k], pixel);
    // The box stands on the table.
    const auto& [x, y, z] = box.centre;
    EXPECT_NEAR(s.tree.plane->signed_distance(x, y, z) - box.size[2] / 2, 0, pixel);
  }
}

TEST(OrientedBox, WithoutAPlaneAlongThePrincipalAxes) {
  const Eigen::Matrix3d frame = turned();
  const std::vector<float> xyz = box_points(frame, {0.3, 0.1, 0.05}, 60000);
  const Segmentation s = segment(CloudView{xyz, {}}, {.method = Method::paper, .plane = false});
  ASSERT_EQ(s.cut.segments.size(), 1U);
  const OrientedBox& box = s.cut.segments[0].oriented_box;
  expect_frame(box);
  EXPECT_NEAR(std::abs(vector(box.axes[0]).dot(frame.col(0))), 1, 1e-3);
  EXPECT_NEAR(std::abs(vector(box.axes[2]).dot(frame.col(2))), 1, 1e-3);
  EXPECT_NEAR(box.size[0], 0.3, 0.01);
  EXPECT_NEAR(box.size[1], 0.1, 0.01);
  EXPECT_NEAR(box.size[2], 0.05, 0.01);
  EXPECT_LT(vector(box.axes[2]).dot(vector(box.centre)), 0) << "not towards the sensor";
}

TEST(Neighbours, AllThatTouchByTheValueAtWhichTheyDo) {
  // One box with two boxes on top.
  const TableScene scene({{{-0.2, -0.05, 0}, {0.2, 0.15, 0.06}},
                          {{-0.15, 0.0, 0.06}, {-0.05, 0.1, 0.18}},
                          {{0.04, 0.0, 0.06}, {0.14, 0.1, 0.16}}});
  const Segmentation s = segment(CloudView{scene.xyz(), {}});
  ASSERT_EQ(s.cut.segments.size(), 3U);
  std::size_t with_two = 0;
  for (const Segment& g : s.cut.segments) {
    ASSERT_FALSE(g.neighbours.empty());
    with_two += g.neighbours.size() == 2;
    EXPECT_EQ(g.neighbour, g.neighbours[0].label);
    EXPECT_EQ(g.meets_at, g.neighbours[0].meets_at);
    EXPECT_TRUE(std::ranges::is_sorted(g.neighbours, {}, &Neighbour::meets_at));
    for (const Neighbour& n : g.neighbours) {
      const auto& back = s.cut.segments[n.label - 1].neighbours;
      EXPECT_NE(std::ranges::find(back, Neighbour{g.label, n.meets_at}), back.end());
      // Checks that the segments join at the value at which they touch, or earlier.
      EXPECT_LE(first_meeting(s, g.label, n.label)->value, n.meets_at);
    }
    EXPECT_EQ(first_meeting(s, g.label, g.neighbour)->value, g.meets_at);
  }
  EXPECT_EQ(with_two, 1U) << "the box below touches both, these only it";
}

TEST(Neighbours, OfMethodPaperBelowItsDistance) {
  const TableScene scene(
      {{{-0.12, -0.05, 0}, {-0.02, 0.05, 0.1}}, {{0.02, -0.05, 0}, {0.12, 0.05, 0.1}}});
  const Segmentation s =
      segment(CloudView{scene.xyz(), {}}, {.method = Method::paper, .distance = 0.06, .steps = 0});
  EXPECT_TRUE(s.cut.segments.at(0).neighbours.empty());
  const SceneCut apart = cut(s.tree, {.value = 0.03});
  ASSERT_EQ(apart.segments.size(), 2U);
  ASSERT_EQ(apart.segments[0].neighbours.size(), 1U);
  EXPECT_EQ(apart.segments[0].neighbours[0].label, 2U);
  EXPECT_EQ(apart.segments[0].meets_at, first_meeting(s.tree, apart, 1, 2)->value);
  EXPECT_NEAR(apart.segments[0].meets_at, 0.045, 0.01);
}

}  // namespace
}  // namespace ph::segment
