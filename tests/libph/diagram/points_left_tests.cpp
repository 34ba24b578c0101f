// SPDX-License-Identifier: MIT
// Takes points from a tree and from a list, and compares the points that are left.
#include "libph/src/diagram/bottleneck/points_left.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace ph::diagram {
namespace {

std::vector<Point> random_points(std::mt19937& random, std::size_t count) {
  std::vector<Point> points;
  // There are few different coordinates, and therefore many equal distances.
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({static_cast<double>(random() % 20), static_cast<double>(random() % 20)});
  return points;
}

TEST(PointsLeft, AreThoseOfAList) {
  std::mt19937 random(1);
  for (const std::size_t count : {1U, 2U, 8U, 9U, 16U, 17U, 100U, 333U}) {
    const std::vector<Point> points = random_points(random, count);
    const PointTree tree(points, default_context());
    PointsLeft left(tree, default_context());
    std::set<std::uint32_t> list;  // the points that are left
    for (std::uint32_t q = 0; q < count; ++q) list.insert(q);
    const auto apart = [&](const Point& p, std::uint32_t q) {
      const Point& other = points[tree.places()[q]];
      return std::max(std::abs(p[0] - other[0]), std::abs(p[1] - other[1]));
    };
    for (int step = 0; step < 2000; ++step) {
      const Point p = random_points(random, 1).front();
      const double radius = static_cast<double>(random() % 6);
      std::set<std::uint32_t> within;
      double nearest = 15;
      for (const std::uint32_t q : list) {
        if (apart(p, q) <= radius) within.insert(q);
        nearest = std::min(nearest, apart(p, q));
      }
      const PointsLeft::Nearest found = left.nearest(p, 15);
      ASSERT_EQ(found.distance, nearest);
      if (nearest < 15) {
        ASSERT_TRUE(list.contains(found.position));
        ASSERT_EQ(apart(p, found.position), nearest);
      } else {
        ASSERT_EQ(found.position, kNone);
      }
      switch (random() % 8) {
        case 0:  // takes all points in reach
          left.take_all(p, radius, [&](std::uint32_t q) {
            ASSERT_EQ(within.erase(q), 1U);
            list.erase(q);
          });
          ASSERT_TRUE(within.empty());
          break;
        case 1: {
          const auto q = static_cast<std::uint32_t>(random() % count);
          ASSERT_EQ(left.has(q), list.contains(q));
          if (list.erase(q) == 1) left.remove(q);
          break;
        }
        case 2:
          if (list.size() > count / 4) break;
          left.restore([](std::uint32_t q) { return q % 3 != 0; });
          for (std::uint32_t q = 0; q < count; ++q) {
            if (q % 3 != 0)
              list.insert(q);
            else
              list.erase(q);
          }
          break;
        case 3:
          if (!list.empty()) break;
          left.restore_all();
          for (std::uint32_t q = 0; q < count; ++q) list.insert(q);
          break;
        default: {
          const auto near = static_cast<std::uint32_t>(random() % count);
          const std::uint32_t q = left.take(p, radius, near);
          ASSERT_EQ(q == kNone, within.empty());
          if (q == kNone) break;
          ASSERT_TRUE(within.contains(q));
          list.erase(q);
        }
      }
    }
  }
}

}  // namespace
}  // namespace ph::diagram
