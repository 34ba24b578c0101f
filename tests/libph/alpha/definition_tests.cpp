// SPDX-License-Identifier: MIT
// Compares values and bars with the definition, computed with exact numbers. With PH_TEST_SEEDS=50,
// the tests try more than 20 000 sets of points.
#include <gtest/gtest.h>

#include "tests/libph/alpha/alpha_oracle.hpp"
#include "tests/libph/alpha/alpha_support.hpp"
#include "tests/libph/alpha/expect_bars.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

/// The tolerance for values: the rounding errors are relative to the largest coordinates and
/// weights.
double tolerance(const Cloud& cloud) {
  double most = largest_coordinate(cloud.points);
  most *= most;
  for (const double w : cloud.weights) most = std::max(most, std::abs(w));
  return 1e-13 * most;
}

void check_definition(const Cloud& cloud) {
  const AlphaOracle oracle(cloud.points, cloud.weights);
  const Alpha alpha(cloud.points, cloud.options());
  const double absolute = tolerance(cloud);
  // Each simplex and its value agree with the definition.
  for (int dim = 0; dim <= alpha.top_dim(); ++dim)
    alpha.for_each_cell(dim, [&](const Alpha::Cell& cell) {
      std::vector<Index> numbers;
      alpha.append_input_cell(dim, cell, numbers);
      unsigned simplex = 0;
      for (const Index v : numbers) simplex |= 1U << v;
      const auto at = oracle.values().find(simplex);
      ASSERT_NE(at, oracle.values().end()) << "no simplex: " << simplex;
      EXPECT_TRUE(is_near(alpha.value(cell), at->second, absolute))
          << alpha.value(cell) << " for " << static_cast<double>(at->second);
    });
  for (const int p : {2, 3, 5})
    expect_bars(persistence(alpha, {.field = p}), oracle.bars(p), absolute);
  for (const std::uint32_t v : alpha.hidden())
    EXPECT_FALSE(oracle.is_ever_alone(v)) << "point " << v << " is not hidden";
}

TEST(AlphaDefinition, AnyPoints) {
  for_each_seed(200, [](Generator& random, bool, std::int64_t) {
    const Cloud cloud = any_cloud(random, 9, false);
    SCOPED_TRACE(cloud.name);
    check_definition(cloud);
  });
}

TEST(AlphaDefinition, AnyWeights) {
  for_each_seed(200, [](Generator& random, bool, std::int64_t) {
    const Cloud cloud = any_cloud(random, 9, true);
    SCOPED_TRACE(cloud.name);
    check_definition(cloud);
  });
}

TEST(AlphaDefinition, TwelvePoints) {
  for_each_seed(6, [](Generator& random, bool ties, std::int64_t) {
    Cloud cloud{"", random.points(12, random.integer(2, 3), ties), {}};
    const bool weighted = random.coin();
    for (int i = 0; weighted && i < 12; ++i)
      cloud.weights.push_back(ties ? random.integer(-1, 2) : random.real() / 4);
    check_definition(cloud);
  });
}

}  // namespace
}  // namespace ph::test
