// SPDX-License-Identifier: MIT
#include "ph/run_context.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <new>
#include <stop_token>
#include <thread>
#include <vector>

#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

TEST(ForEachInput, TakesEachOnce) {
  for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
    for (const int threads : {0, 1, 2, 5}) {
      ThreadsContext context(threads);
      std::vector<std::atomic<int>> taken(count);
      for_each_input(count, context, [&](std::size_t i, const RunContext&) { ++taken[i]; });
      for (const auto& times : taken) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ForEachInput, GivesTheBarsOfEach) {
  ThreadsContext context(3);
  std::vector<Points> clouds;
  for_each_seed(200, [&](Generator& random, bool ties, std::int64_t) {
    clouds.push_back(random.points(random.integer(0, 12), 2, ties));
  });
  std::vector<Barcode> bars(clouds.size());
  for_each_input(clouds.size(), context, [&](std::size_t i, const RunContext& of_input) {
    bars[i] = persistence(Rips(clouds[i], {}, of_input), {}, of_input);
  });
  for (std::size_t i = 0; i < clouds.size(); ++i)
    EXPECT_EQ(first_difference(bars[i], persistence(Rips(clouds[i]))), "") << i;
}

TEST(ForEachInput, SharesThreadsAndMemoryOut) {
  ThreadsContext context(6);
  context.memory.set_limit(1000);
  const MemoryClaim taken(context.memory, 400);
  for (const std::size_t count : {1U, 2U, 4U, 9U}) {
    for_each_input(count, context, [&](std::size_t, const RunContext& of_input) {
      EXPECT_EQ(of_input.threads, count > 6 ? 1 : 6 / static_cast<int>(count));
      EXPECT_EQ(of_input.memory.limit(), 600U);
    });
  }
  // One input may take all the memory that is left. The next input can take the same memory again.
  context.threads = 1;
  for_each_input(2, context, [&](std::size_t i, const RunContext& of_input) {
    const MemoryClaim most(of_input.memory, 600);
    EXPECT_EQ(of_input.memory.left(), 0U) << i;
  });
}

TEST(Threads, AreNoNegativeNumber) {
  RunContext context;
  context.threads = -3;
  expect_error(ErrorKind::usage, "threads: found -3, expected 0 or more",
               [&] { for_each_input(9, context, [](std::size_t, const RunContext&) {}); });
}

TEST(ForEachInput, CountsWhatIsKeptOfEach) {
  ThreadsContext context(1);
  context.memory.set_limit(1000);
  std::vector<std::unique_ptr<MemoryClaim>> kept;
  try {
    for_each_input(9, context, [&](std::size_t i, const RunContext& of_input) {
      EXPECT_EQ(of_input.memory.left(), 1000 - 300 * i);
      const MemoryClaim work(of_input.memory, 300);
      EXPECT_EQ(of_input.memory.left(), 700 - 300 * i);
      kept.push_back(std::make_unique<MemoryClaim>(context.memory, 300));
    });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind(), ErrorKind::resource);
    EXPECT_EQ(error.input(), 2U);
  }
  EXPECT_EQ(kept.size(), 2U);
}

TEST(ForEachInput, NamesTheFirstThatFails) {
  ThreadsContext context(1);
  int taken = 0;
  try {
    for_each_input(9, context, [&](std::size_t i, const RunContext&) {
      ++taken;
      if (i >= 3) throw Error(ErrorKind::bad_data, "no number");
    });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_data);
    EXPECT_EQ(error.input(), 3U);
    EXPECT_EQ(error.reason(), "no number");
    EXPECT_STREQ(error.what(), "input 3: no number");
  }
  EXPECT_EQ(taken, 4);
  EXPECT_THROW(
      for_each_input(2, context, [](std::size_t, const RunContext&) { throw std::bad_alloc(); }),
      std::bad_alloc);
}

/// Waits until the context is stopped. If it is never stopped, the time limit ends the wait.
void wait_for_a_stop(const RunContext& context) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (std::chrono::steady_clock::now() < end) context.poll();
}

TEST(ForEachInput, AnErrorStopsTheOthers) {
  ThreadsContext context(2);
  try {
    for_each_input(3, context, [](std::size_t i, const RunContext& of_input) {
      if (i == 1) throw Error(ErrorKind::usage, "this one");
      wait_for_a_stop(of_input);
      ADD_FAILURE() << "input " << i << " was not stopped";
    });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "input 1: this one");
  }
}

TEST(ForEachInput, StopsOnRequestAndTellsOfInputs) {
  std::stop_source stop;
  ThreadsContext context(2);
  context.stop = stop.get_token();
  EXPECT_TRUE(fails_with(ErrorKind::cancelled, [&] {
    for_each_input(5, context, [&](std::size_t i, const RunContext& of_input) {
      if (i == 0) stop.request_stop();
      wait_for_a_stop(of_input);
    });
  }));
  ThreadsContext told(1);
  std::uint64_t done = 0;
  told.on_progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "inputs");
    EXPECT_EQ(progress.total, 4U);
    EXPECT_GT(progress.done, done);
    done = progress.done;
  };
  for_each_input(4, told, [](std::size_t, const RunContext& of_input) {
    EXPECT_FALSE(of_input.on_progress);
    std::this_thread::sleep_for(std::chrono::milliseconds(110));
  });
  EXPECT_EQ(done, 4U);
}

}  // namespace
}  // namespace ph::test
