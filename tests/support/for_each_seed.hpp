// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "support/generators.hpp"

namespace ph::test {

/// Runs `check(generator, ties, field)` for `count` seeds: every other one with heavy ties, each
/// with one of four fields. Stops at the first failure, which names the seed.
template <class Check>
void for_each_seed(int count, Check&& check) {
  static constexpr std::int64_t fields[] = {2, 3, 5, 11};
  for (int seed = 0; seed < count && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Generator random(static_cast<std::uint64_t>(seed));
    check(random, seed % 2 == 0, fields[seed / 2 % 4]);
  }
}

}  // namespace ph::test
