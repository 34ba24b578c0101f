// SPDX-License-Identifier: MIT
// Merge trees of alpha complexes. Their vertices are the points of the input, including hidden and
// equal points.
#include <gtest/gtest.h>

#include <cmath>

#include "ph/alpha.hpp"
#include "ph/merge_tree.hpp"
#include "tests/libph/alpha/alpha_support.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

// The squared radius at which two weighted balls meet.
double meeting(const Points& points, const std::vector<double>& weights, Index u, Index v) {
  double square = 0;
  for (Index k = 0; k < points.cols(); ++k) square += std::pow(points(u, k) - points(v, k), 2);
  if (weights.empty()) return square / 4;
  const double a = weights[static_cast<std::size_t>(u)], b = weights[static_cast<std::size_t>(v)];
  // The smaller ball appears inside the other ball.
  if (std::abs(a - b) >= square) return std::max(-a, -b);
  return std::pow((square + a - b) / 2, 2) / square - a;
}

TEST(AlphaTree, VerticesArePoints) {
  for_each_seed(200, [](Generator& random, bool weighted, std::int64_t) {
    const Cloud cloud = any_cloud(random, 40, weighted);
    SCOPED_TRACE(cloud.name);
    const Alpha alpha(cloud.points, cloud.options());
    const MergeTree tree = merge_tree(alpha);
    ASSERT_EQ(tree.size(), cloud.points.rows());
    std::vector<bool> is_hidden(tree.births.size());
    for (const std::uint32_t v : alpha.hidden()) is_hidden[v] = true;
    // A ball may appear inside other balls and reach their surface only later.
    for (std::size_t v = 0; v < is_hidden.size(); ++v)
      if (is_hidden[v] || !weighted)
        EXPECT_EQ(tree.births[v], is_hidden[v] ? kInfinity : 0.0);
      else
        EXPECT_GE(tree.births[v], -cloud.weights[v]);
    for (const Merge& m : tree.merges) {
      EXPECT_EQ(m.younger_birth, tree.births[static_cast<std::size_t>(m.younger)]);
      EXPECT_EQ(m.elder_birth, tree.births[static_cast<std::size_t>(m.elder)]);
      if (weighted && m.persistence() == 0) continue;
      EXPECT_NEAR(m.value, meeting(cloud.points, cloud.weights, m.u, m.v), 1e-12 * 81)
          << m.u << " " << m.v;
    }
  });
}

}  // namespace
}  // namespace ph::test
