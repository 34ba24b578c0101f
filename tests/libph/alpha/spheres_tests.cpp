// SPDX-License-Identifier: MIT
// The signs computed by exact geometric tests, which must not depend on rounding. The signs are
// tested directly, because a wrong sign seldom changes a bar.
#include <gtest/gtest.h>

#include "tests/libph/alpha/exact_spheres.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

TEST(AlphaSpheres, SignsAndRadiiAreThoseOfIntegers) {
  for_each_seed(3000, [](Generator& random, bool weighted, std::int64_t) {
    const Index count = random.integer(2, 5), coordinates = random.integer(1, 3);
    // Integers or decimals. Right angles and cospherical points are exact for integers, and exact
    // up to rounding for decimals.
    const double step = random.coin() ? 0.1 : 1;
    const bool moves = random.coin();
    const auto number = [&](int low, int high) {
      double x = step * random.integer(low, high);
      for (int left = moves && x != 0 ? random.integer(0, 2) : 0; left > 0; --left)
        x = std::nextafter(x, 9);
      return x;
    };
    Points points(count, coordinates);
    for (double& x : points.coordinates()) x = number(-3, 3);
    // Flattens some sets of points so much that twice the precision of a double is not enough to
    // find a sign.
    const Index flat = random.integer(0, 4);
    for (Index i = 0; flat < coordinates && i < count; ++i) points(i, flat) *= 1e-25;
    std::vector<double> weights;
    for (Index i = 0; weighted && i < count; ++i) weights.push_back(step * number(-2, 4));
    RunContext context;
    const alpha::Sites sites = alpha::sites_of(points, weights, context);
    EXPECT_EQ(Faces(sites).violation(), "");
  });
}

}  // namespace
}  // namespace ph::test
