// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>
#include <cstdlib>
#include <string>

#include "tests/support/generators.hpp"

namespace ph::test {

/// The number of seeds to try. It is `count`, or at least 1 and `count` times the environment
/// variable PH_TEST_SEEDS if it is set, for example to 0.02 for a quick look or to 250 for a long
/// search.
inline int seeds(int count) {
  const char* times = std::getenv("PH_TEST_SEEDS");
  return times ? std::max(1, static_cast<int>(count * std::atof(times))) : count;
}

/// True if the cases for which a random test was written have occurred more than `least` times. If
/// the number of seeds is reduced, always true.
template <class Count>
bool is_enough(Count count, Count least) {
  return count > least || seeds(100) < 100;
}

/// Runs `check(generator)` or `check(generator, ties, field)` for `seeds(count)` seeds. Every
/// second seed has many ties, and each seed has one of four fields. Stops at the first failure,
/// which names the seed.
template <class Check>
void for_each_seed(int count, Check&& check) {
  static constexpr std::int64_t fields[] = {2, 3, 5, 11};
  for (int seed = 0; seed < seeds(count) && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Generator random(static_cast<std::uint64_t>(seed));
    if constexpr (std::invocable<Check, Generator&>)
      check(random);
    else
      check(random, seed % 2 == 0, fields[seed / 2 % 4]);
  }
}

}  // namespace ph::test
