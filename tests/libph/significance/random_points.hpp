// SPDX-License-Identifier: MIT
#pragma once
#include <random>

#include "ph/points.hpp"

namespace ph::test {

/// Points distributed uniformly in a cube.
inline Points random_points(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<> number(0, 1);
  Points points(count, dimension);
  for (Index i = 0; i < count; ++i)
    for (Index k = 0; k < dimension; ++k) points(i, k) = number(random);
  return points;
}

}  // namespace ph::test
