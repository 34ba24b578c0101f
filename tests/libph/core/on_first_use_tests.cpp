// SPDX-License-Identifier: MIT
#include "ph/detail/core/on_first_use.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <thread>
#include <vector>

namespace ph::detail {
namespace {

std::atomic<int> made = 0;

int* value() {
  static constinit OnFirstUse number([] { return ++made; });
  return &*number;
}

TEST(OnFirstUse, AllThreadsGetTheSameValue) {
  EXPECT_EQ(made, 0);
  std::vector<int*> found(8);
  std::barrier start(8);
  {
    std::vector<std::jthread> threads;
    for (int*& place : found)
      threads.emplace_back([&] {
        start.arrive_and_wait();
        place = value();
      });
  }
  for (const int* place : found) EXPECT_EQ(place, found[0]);
  const int all = made;
  EXPECT_GE(all, 1);
  value();
  EXPECT_EQ(made, all);
}

}  // namespace
}  // namespace ph::detail
