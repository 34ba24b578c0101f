// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/stages.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <numbers>
#include <vector>

#include "ph/error.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::segment {
namespace {

constexpr double kVoxel = 0.005;

/// A cloud with two walls, 4 cm high. A bowl shows such walls: its outside in front and its inside
/// behind.
class TwoWalls {
 public:
  void add(double x, double y, double top, Index part) {
    for (double z = top; z > top - 0.04; z -= kVoxel) {
      points_.push_back({x, y, z});
      part_of_.push_back(part);
    }
  }
  void add_arc(double from, double to, double radius, double top, Index part) {
    for (double a = from; a < to; a += kVoxel / radius)
      add(radius * std::cos(a), radius * std::sin(a), top, part);
  }
  bool joined() const {
    Points points(std::ssize(points_), 3);
    for (Index i = 0; i < points.rows(); ++i)
      for (Index k = 0; k < 3; ++k)
        points(i, k) = points_[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    std::vector<Index> first(2, -1), part_of;
    for (std::size_t i = 0; i < part_of_.size(); ++i) {
      Index& example = first[static_cast<std::size_t>(part_of_[i])];
      if (example < 0) example = static_cast<Index>(i);
      part_of.push_back(example);
    }
    int joins = 0;
    join_around_rims(points, kVoxel, {0, 0, 1}, number_parts(part_of, 32),
                     [&](std::uint32_t p, std::uint32_t q) {
                       EXPECT_EQ(p + q, 1U);
                       ++joins;
                     });
    EXPECT_LE(joins, 1);
    return joins == 1;
  }

 private:
  std::vector<Vec3> points_;
  std::vector<Index> part_of_;
};

TEST(Rims, ThousandsOfSpecksOfOneHeightAreNotAllCompared) {
  constexpr int a_side = 110;
  std::vector<Vec3> places;
  std::vector<Index> part_of;
  for (int i = 0; i < a_side * a_side; ++i) {
    const auto first = static_cast<Index>(places.size());
    for (int k = 0; k < 27; ++k) {
      places.push_back({0.05 * (i % a_side) + kVoxel * (k % 3),
                        0.05 * (i / a_side) + kVoxel * (k / 3 % 3), kVoxel * (k / 9)});
      part_of.push_back(first);
    }
  }
  Points points(std::ssize(places), 3);
  for (Index i = 0; i < points.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      points(i, static_cast<Index>(k)) = places[static_cast<std::size_t>(i)][k];
  const auto start = std::chrono::steady_clock::now();
  int joins = 0;
  join_around_rims(points, kVoxel, {0, 0, 1}, number_parts(part_of, 1),
                   [&](std::uint32_t, std::uint32_t) { ++joins; });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::cout << a_side * a_side << " specks in " << took.count() << " s\n";
  EXPECT_EQ(joins, 0);
  EXPECT_LT(took.count(), 10) << "seventy million circles take minutes";

  ph::test::StoppedContext context;
  EXPECT_THROW(join_around_rims(
                   points, kVoxel, {0, 0, 1}, number_parts(part_of, 1),
                   [](std::uint32_t, std::uint32_t) {}, context),
               Error);
}

constexpr double kPi = std::numbers::pi;

TEST(Rims, ArcsOfOneCircleBelongTogether) {
  for (const double radius : {0.035, 0.08, 0.15}) {
    TwoWalls bowl;
    bowl.add_arc(0.1, kPi - 0.1, radius, 0.07, 0);
    bowl.add_arc(kPi + 0.1, 2 * kPi - 0.1, radius, 0.07, 1);
    EXPECT_TRUE(bowl.joined()) << radius;
  }
}

TEST(Rims, ArcsAtDifferentHeightsDoNot) {
  TwoWalls steps;
  steps.add_arc(0, kPi, 0.08, 0.07, 0);
  steps.add_arc(kPi, 2 * kPi, 0.08, 0.09, 1);
  EXPECT_FALSE(steps.joined());
}

TEST(Rims, ArcsThatLeaveTheCircleOpenDoNot) {
  TwoWalls open;
  open.add_arc(0, 0.42 * kPi, 0.08, 0.07, 0);
  open.add_arc(kPi, 1.42 * kPi, 0.08, 0.07, 1);
  EXPECT_FALSE(open.joined());
  TwoWalls half;  // the visible part of a mug at two metres
  half.add_arc(0, 0.6 * kPi, 0.08, 0.07, 0);
  half.add_arc(kPi, 1.6 * kPi, 0.08, 0.07, 1);
  EXPECT_TRUE(half.joined());
}

TEST(Rims, ArcsOfDifferentCirclesDoNot) {  // two cups, one behind the other
  TwoWalls cups;
  cups.add_arc(0, kPi, 0.04, 0.07, 0);
  cups.add_arc(kPi, 2 * kPi, 0.07, 0.07, 1);
  EXPECT_FALSE(cups.joined());
}

TEST(Rims, StraightEdgesDoNot) {
  for (const double gap : {0.0, 0.1}) {  // both edges on one line, or on two sides of a box
    TwoWalls edges;
    for (double x = 0; x < 0.1; x += kVoxel) {
      edges.add(x, 0, 0.07, 0);
      edges.add(gap == 0 ? x + 0.11 : x, gap, 0.07, 1);
    }
    EXPECT_FALSE(edges.joined()) << gap;
  }
}

}  // namespace
}  // namespace ph::segment
