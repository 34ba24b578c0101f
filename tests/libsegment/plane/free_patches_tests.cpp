// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace ph::segment {
namespace {

/// A table at z = 1, seen from the origin. Its squares are axis-aligned, because Eigen's
/// unitOrthogonal of (0, 0, -1) is an axis.
constexpr Plane kTable{{0, 0, -1}, 1, 1};
constexpr double kSide = 0.064;
using Square = std::pair<int, int>;

struct Table {
  std::vector<float> xyz;
  std::vector<Index> points, beyond;

  /// Adds a point of the table. The unit of x and y is the side of a square.
  void add(double x, double y, double height) { points.push_back(put(x, y, height)); }
  /// Adds a point of an object on the table.
  void over(double x, double y) { beyond.push_back(put(x, y, 0.03)); }
  /// Adds a block of `count` x `count` squares that begins at (x, y). Each square has n * n points.
  void add_squares(int x, int y, int count, int n = 8) {
    for (int i = 0; i < n * count; ++i)
      for (int j = 0; j < n * count; ++j) add(x + (i + 0.5) / n, y + (j + 0.5) / n, 0);
  }
  Index put(double x, double y, double height) {
    for (const double c : {x * kSide, y * kSide, 1 - height}) xyz.push_back(static_cast<float>(c));
    return static_cast<Index>(xyz.size() / 3) - 1;
  }
  std::vector<Index> free() const { return free_patches({xyz, {}}, points, beyond, kTable, kSide); }
  Square square_of(Index i) const {
    const auto k = 3 * static_cast<std::size_t>(i);
    return {static_cast<int>(std::floor(xyz[k] / kSide)),
            static_cast<int>(std::floor(xyz[k + 1] / kSide))};
  }
  /// The number of points that were taken from each square.
  std::map<Square, int> squares() const {
    std::map<Square, int> counts;
    for (const Index i : free()) ++counts[square_of(i)];
    return counts;
  }
};

TEST(FreePatches, AreNotUnderObjects) {
  for (const int above : {0, 2, 3, 8}) {  // up to two points may be flying pixels
    Table table;
    table.add_squares(-2, -2, 4);
    for (int k = 0; k < above; ++k) table.over(-1 + (k + 0.5) / 8, 1.5);
    const std::map<Square, int> squares = table.squares();
    EXPECT_EQ(squares.contains(Square{-1, 1}), above <= 2) << above;
    EXPECT_EQ(squares.size(), above <= 2 ? 16U : 15U) << above;
    for (const auto& [square, count] : squares) EXPECT_EQ(count, 64);
  }
}

TEST(FreePatches, HaveEnoughPoints) {
  for (const int missing : {32, 33}) {  // half of the points of a full square are enough
    Table table;
    table.add_squares(0, 0, 1);
    table.points.resize(table.points.size() - static_cast<std::size_t>(missing));
    EXPECT_EQ(table.free().size(), missing == 32 ? 32U : 0U);
  }
  EXPECT_TRUE(Table().free().empty());
}

TEST(FreePatches, AreAFewNearOnesAndFarOnes) {
  Table table;
  table.add_squares(-10, -10, 20);
  table.add_squares(10, 0, 8);
  const std::map<Square, int> squares = table.squares();
  EXPECT_EQ(squares.size(), 24U);
  // The chosen squares are spread over all distances from the foot of the viewpoint. If the 464
  // squares are sorted by distance, each quarter of them contains six chosen squares.
  const auto farness = [](const Square& s) { return std::hypot(s.first + 0.5, s.second + 0.5); };
  std::vector<double> of_all;
  for (int x = -10; x < 18; ++x)
    for (int y = -10; y < 10; ++y)
      if (x < 10 || (y >= 0 && y < 8)) of_all.push_back(farness({x, y}));
  std::ranges::sort(of_all);
  std::vector<double> of_taken;
  for (const auto& [square, count] : squares) of_taken.push_back(farness(square));
  std::ranges::sort(of_taken);
  for (std::size_t k = 0; k < 24; ++k)
    EXPECT_NEAR(of_taken[k], of_all[(2 * k + 1) * of_all.size() / 48], 1e-9) << k;
}

TEST(FreePatches, DoNotDependOnTheOrderOfThePoints) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-8, 8), height(-0.004, 0.0051);
  Table table;
  for (int i = 0; i < 40000; ++i) table.add(place(random), place(random), height(random));
  Table shuffled = table;
  std::ranges::shuffle(shuffled.points, random);
  std::ranges::shuffle(shuffled.beyond, random);
  std::vector<Index> a = table.free(), b = shuffled.free();
  EXPECT_GT(a.size(), 24U * 32);
  EXPECT_LT(a.size(), table.points.size());
  EXPECT_TRUE(std::ranges::is_sorted(a));
  EXPECT_FALSE(std::ranges::is_sorted(b)) << "they come in the order of the points";
  std::ranges::sort(b);
  EXPECT_EQ(a, b);
}

TEST(FreePatches, PointsThatAreThereTwiceChangeNothing) {
  Table once;
  once.add_squares(0, 0, 1);
  once.points.resize(31);  // too few points, however often they are repeated
  once.add_squares(1, 0, 1);
  for (int k = 0; k < 2; ++k) once.over(1.1 + 0.2 * k, 0.5);  // too few points for an object
  Table often = once;
  for (int times = 0; times < 3; ++times) {
    often.points.insert(often.points.end(), once.points.begin(), once.points.end());
    often.beyond.insert(often.beyond.end(), once.beyond.begin(), once.beyond.end());
  }
  EXPECT_EQ(once.squares(), (std::map<Square, int>{{{1, 0}, 64}}));
  EXPECT_EQ(often.squares(), (std::map<Square, int>{{{1, 0}, 4 * 64}}));
}

TEST(FreePatches, AreThereOnAPlaneWithoutEnd) {
  for (const double far : {100.0, 1e6, 1e30}) {  // distance in squares
    Table table;
    table.add_squares(0, 0, 3);
    table.add(far, 0.5, 0);
    table.add(0.5, -far, 0);
    const std::vector<Index> free = table.free();
    EXPECT_EQ(std::ranges::count_if(free, [](Index i) { return i < 9 * 64; }), 9 * 64) << far;
  }
}

}  // namespace
}  // namespace ph::segment
