// SPDX-License-Identifier: MIT
#include <cstdint>
#include <map>

#include "ph/detail/core/flat_map.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

// Numbers that a table might reserve for its own use, and numbers whose upper and lower 32 bits are
// -2, -1, 0 or 1.
std::vector<std::uint64_t> keys_at_the_ends() {
  std::vector<std::uint64_t> keys = {1ULL << 63, (1ULL << 63) - 1};
  for (const int high : {-2, -1, 0, 1})
    for (const int low : {-2, -1, 0, 1})
      keys.push_back(std::uint64_t{static_cast<std::uint32_t>(high)} << 32 |
                     static_cast<std::uint32_t>(low));
  return keys;
}

TEST(FlatMap, EveryNumberIsAKey) {
  for (const std::uint64_t key : keys_at_the_ends()) {
    FlatMap<int> map(std::pmr::get_default_resource());
    for (const std::uint64_t other : keys_at_the_ends()) EXPECT_EQ(map.find(other), nullptr);
    const auto [value, is_new] = map.try_emplace(key);
    EXPECT_TRUE(is_new);
    EXPECT_EQ(*value, 0);
    *value = 7;
    EXPECT_FALSE(map.try_emplace(key).second);
    for (const std::uint64_t other : keys_at_the_ends()) {
      const int* found = map.find(other);
      ASSERT_EQ(found != nullptr, other == key) << key << ' ' << other;
      if (found) {
        EXPECT_EQ(*found, 7);
      }
    }
    map.clear();
    EXPECT_EQ(map.find(key), nullptr);
    EXPECT_TRUE(map.try_emplace(key).second);
    EXPECT_EQ(*map.find(key), 0);  // not the value stored before
  }
}

TEST(FlatMap, EqualsASlowOne) {
  const std::vector<std::uint64_t> ends = keys_at_the_ends();
  for_each_seed(40, [&](auto& random, bool ties, std::int64_t) {
    FlatMap<int> map(std::pmr::get_default_resource());
    std::map<std::uint64_t, int> slow;
    const int most = random.coin() ? 20 : 400;
    const auto key = [&] {
      if (random.integer(0, 9) == 0)
        return ends[static_cast<std::size_t>(random.integer(0, static_cast<int>(ends.size()) - 1))];
      const auto number = static_cast<std::uint64_t>(random.integer(-most, most));
      return ties ? number : number << 32 | number;
    };
    for (int i = 0; i < 2000; ++i) {
      const std::uint64_t k = key();
      const auto [value, is_new] = map.try_emplace(k);
      ASSERT_EQ(is_new, slow.try_emplace(k).second) << k;
      ASSERT_EQ(*value, slow[k]) << k;
      *value = slow[k] = i;
      const std::uint64_t other = key();
      const auto in_slow = slow.find(other);
      const int* found = map.find(other);
      ASSERT_EQ(found != nullptr, in_slow != slow.end()) << other;
      if (found) {
        ASSERT_EQ(*found, in_slow->second) << other;
      }
      if (random.integer(0, 499) == 0) {
        map.clear();
        slow.clear();
      }
      if (random.integer(0, 499) == 0)
        map.reserve(static_cast<std::size_t>(random.integer(0, 2 * most)));
    }
  });
}

}  // namespace
}  // namespace ph::test
