// SPDX-License-Identifier: MIT
// Checks for each pair of points that the prices prove a matching to be optimal. Also tests
// auctions that are abandoned.
#include "libph/src/diagram/wasserstein/assignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "libph/src/diagram/wasserstein/auction.hpp"
#include "ph/barcode.hpp"

namespace ph::diagram {
namespace {

std::vector<Point> random_points(std::mt19937& random, std::size_t count, int steps) {
  std::uniform_real_distribution<> number(0, 1);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    double birth = number(random), length = number(random) / 4;
    if (steps > 0) {
      birth = std::floor(birth * steps);
      length = 1 + std::floor(length * steps);
    }
    points.push_back({birth, birth + length});
  }
  return points;
}

long double power(long double distance, int order) {
  return order == 1 ? distance : distance * distance;
}

/// Checks optimality by the duality of linear programs: the prices are feasible, and the sum of the
/// prices and the cost of the pairs both equal the stated cost. The sums are computed in higher
/// precision than the prices.
void expect_proof(const Assignment& found, int order, const std::string& where) {
  const auto &a = found.side(0), &b = found.side(1);
  const auto alone = [&](const Point& p) {
    return power((static_cast<long double>(p[1]) - p[0]) / 2, order);
  };
  const auto pair = [&](const Point& p, const Point& q) {
    return power(std::max(std::abs(static_cast<long double>(p[0]) - q[0]),
                          std::abs(static_cast<long double>(p[1]) - q[1])),
                 order);
  };
  constexpr long double rounding = 4e-15L;  // in units of the largest cost, which is about 1
  long double sum = 0, cost = 0;
  std::size_t broken = 0;
  for (std::uint32_t x = 0; x < a.tree.size(); ++x) {
    const long double u = a.prices.weight(x);
    sum += u;
    if (u > alone(a.tree.point(x)) + rounding) ++broken;
    for (std::uint32_t y = 0; y < b.tree.size(); ++y)
      if (u + b.prices.weight(y) > pair(a.tree.point(x), b.tree.point(y)) + rounding) ++broken;
    const std::uint32_t y = a.partner[x];
    if (y == kNone) {
      cost += alone(a.tree.point(x));
    } else {
      ASSERT_EQ(b.partner[y], x) << where;
      cost += pair(a.tree.point(x), b.tree.point(y));
    }
  }
  for (std::uint32_t y = 0; y < b.tree.size(); ++y) {
    sum += b.prices.weight(y);
    if (b.prices.weight(y) > alone(b.tree.point(y)) + rounding) ++broken;
    if (b.partner[y] == kNone) cost += alone(b.tree.point(y));
  }
  ASSERT_EQ(broken, 0U) << where;
  const Assignment::Costs said = found.costs();
  ASSERT_NEAR(static_cast<double>(cost), said.cost, 1e-13 * said.cost) << where;
  ASSERT_LE(said.lower, std::max(sum, 0.0L)) << where;
  ASSERT_NEAR(static_cast<double>(sum), said.lower, 1e-11 * said.cost + 1e-15) << where;
  ASSERT_LE(said.cost, said.lower + 1e-11 * said.cost) << where;
}

const auto kToTheEnd = [](const Assignment::Costs& costs) {
  return costs.cost - costs.lower <= 1e-13 * costs.cost;
};

TEST(Assignment, PricesProveTheMatching) {
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    const int order = round % 2 + 1, steps = round % 4 < 2 ? 0 : 8;
    const GroundCost cost(order, kInfinity);
    const auto a = random_points(random, 1 + random() % 400, 0);
    const auto b = random_points(random, 1 + random() % 400, 0);
    Assignment found(a, b, cost, default_context());
    ASSERT_TRUE(Auction(found, default_context()).run(kToTheEnd, 1'000'000));
    expect_proof(found, order, std::to_string(round));
    // Because of ties, auctions are long, and many shortest paths are needed. The points are scaled
    // such that costs are about 1.
    auto c = random_points(random, 300, 8), d = random_points(random, 200 + random() % 200, 8);
    for (auto* points : {&c, &d})
      for (Point& p : *points) p = {p[0] / 8, p[1] / 8};
    Assignment tied(c, d, cost, default_context());
    ASSERT_TRUE(Auction(tied, default_context()).run(kToTheEnd, 1'000'000)) << steps;
    expect_proof(tied, order, std::to_string(round) + " tied");
  }
}

// Every computation ends: after a certain number of bids, the auction is abandoned, and shortest
// paths complete the assignment.
TEST(Assignment, ShortestPathsFollowAnAuctionThatIsGivenUp) {
  std::mt19937 random(2);
  for (int round = 0; round < 30; ++round) {
    const int order = round % 2 + 1;
    const GroundCost cost(order, kInfinity);
    auto a = random_points(random, 1 + random() % 300, round % 3 == 0 ? 0 : 8);
    auto b = random_points(random, 1 + random() % 300, round % 3 == 0 ? 0 : 8);
    if (round % 3 != 0)
      for (auto* points : {&a, &b})
        for (Point& p : *points) p = {p[0] / 8, p[1] / 8};
    if (round % 5 == 0) b = a;
    if (round % 5 == 1) b.assign(b.size(), b.front());  // many copies of one bar
    Assignment whole(a, b, cost, default_context()), broken(a, b, cost, default_context());
    ASSERT_TRUE(Auction(whole, default_context()).run(kToTheEnd, 1'000'000));
    if (a.size() + b.size() > 40) {
      ASSERT_FALSE(Auction(broken, default_context()).run(kToTheEnd, random() % 10)) << round;
    }
    assign_by_shortest_paths(broken, default_context());
    expect_proof(broken, order, std::to_string(round));
    ASSERT_NEAR(broken.costs().cost, whole.costs().cost, 1e-12 * whole.costs().cost) << round;
  }
}

TEST(Assignment, OfManyTiesByShortestPaths) {
  std::mt19937 random(3);
  auto a = random_points(random, 3000, 16), b = random_points(random, 2500, 16);
  for (auto* points : {&a, &b})
    for (Point& p : *points) p = {p[0] / 16, p[1] / 16};
  Assignment found(a, b, GroundCost(1, kInfinity), default_context());
  assign_by_shortest_paths(found, default_context());
  expect_proof(found, 1, "ties");
}

}  // namespace
}  // namespace ph::diagram
