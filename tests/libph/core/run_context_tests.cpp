// SPDX-License-Identifier: MIT
// Memory counts and limits, stop requests, and progress reports.
#include "ph/run_context.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <climits>
#include <string>
#include <thread>

#include "ph/custom.hpp"
#include "ph/detail/core/machine_memory.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/patience.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

// ---- memory

TEST(MemoryBudgets, WithoutAContextTheMachineIsTheLimit) {
  MemoryBudget& budget = default_context().memory;
  EXPECT_EQ(budget.limit(), machine_memory());
  if (machine_memory() > SIZE_MAX / 4) GTEST_SKIP() << "the system does not report its memory";
  std::pmr::vector<double> numbers(&budget);
  expect_error(ErrorKind::resource, "memory limit",
               [&] { numbers.resize(machine_memory() / sizeof(double) + 1); });
}

TEST(MemoryBudgets, CountAndRefuse) {
  // A block counts with a header of 8 bytes, and its size is a multiple of 16.
  MemoryBudget budget(1008);
  void* a = budget.allocate(600, 8);
  EXPECT_EQ(budget.used(), 608U);
  expect_error(ErrorKind::resource, "memory limit", [&] { (void)budget.allocate(393, 8); });
  EXPECT_EQ(budget.used(), 608U) << "a refusal changes nothing";
  EXPECT_NO_THROW(budget.require(400));
  expect_error(ErrorKind::resource, "memory limit", [&] { budget.require(401); });
  expect_error(ErrorKind::resource, "memory limit", [&] { budget.require(SIZE_MAX); });
  // The number is volatile, because the compiler would warn about a constant.
  const volatile std::size_t huge = SIZE_MAX - 8;
  expect_error(ErrorKind::resource, "memory limit", [&] { (void)budget.allocate(huge, 8); });
  void* b = budget.allocate(392, 64);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b) % 64, 0U);
  budget.deallocate(b, 392, 64);
  budget.deallocate(a, 600, 8);
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_EQ(budget.peak(), 1008U);
}

#if defined(__GLIBC__)
// Columns of a matrix are often this small.
TEST(MemoryBudgets, CountWhatTheCLibraryTakes) {
  MemoryBudget budget;
  for (const std::size_t bytes : {1U, 8U, 16U, 24U, 25U, 40U, 41U, 64U, 1000U, 100'000U}) {
    const std::size_t before = budget.used();
    void* const block = budget.allocate(bytes, 8);
    EXPECT_EQ(budget.used() - before, malloc_usable_size(block) + sizeof(std::size_t)) << bytes;
    budget.deallocate(block, bytes, 8);
    EXPECT_EQ(budget.used(), before);
  }
}
#endif

// Under any limit, a computation either gives the right answer, or frees everything and reports
// that memory is short.
TEST(MemoryBudgets, HoldForEveryEngine) {
  Generator random(3);
  const Points points = random.points(24, 3, false);
  const Image image = random.image({9, 8, 7}, false);
  for (const auto& engine : detail::engine_facts()) {
    SCOPED_TRACE(engine.id.name());
    const bool takes_points = engine.id == Engine::beta_skeleton;
    const int max_dim = engine.id == Engine::union_find                   ? 0
                        : engine.id == Engine::edge_links || takes_points ? 1
                                                                          : 2;
    const Options options{.max_dim = max_dim, .field = 3, .engine = engine.id};
    const auto run = [&](const RunContext& context) {
      if (engine.id == Engine::gradient)
        return persistence(Cubical(image, {}, context), options, context);
      return persistence(Rips(points, {}, context), options, context);
    };
    std::size_t peak = 0;
    Barcode expected;
    {
      RunContext context;
      expected = run(context);
      peak = context.memory.peak();
      EXPECT_EQ(context.memory.used(), 0U);
    }
    for (std::size_t k = 0; k <= 20; ++k) {
      LimitedContext context(peak * k / 20);
      const bool is_short = fails_with(
          ErrorKind::resource, [&] { EXPECT_EQ(bars_of(run(context)), bars_of(expected)); });
      EXPECT_FALSE(is_short && k == 20) << "what was enough once is enough again";
      EXPECT_LE(context.memory.peak(), context.memory.limit());
      EXPECT_EQ(context.memory.used(), 0U);
    }
  }
}

TEST(MemoryBudgets, HoldForImages) {
  Generator random(3);
  const Image image = random.image({20, 20}, false);
  for (const std::size_t limit : {0U, 100U, 5000U, 20000U, 60000U}) {
    LimitedContext context(limit);
    fails_with(ErrorKind::resource, [&] { persistence(Cubical(image, {}, context), {}, context); });
    EXPECT_LE(context.memory.peak(), limit);
    EXPECT_EQ(context.memory.used(), 0U);
  }
}

/// The engines that list all cells of an image.
constexpr Engine kListCells[] = {Engine::standard, Engine::twist, Engine::cohomology,
                                 Engine::union_find};

/// The number of voxels with a finite value.
std::size_t entering(const Image& image) {
  return static_cast<std::size_t>(std::count_if(image.values.begin(), image.values.end(),
                                                [](double v) { return v < kInfinity; }));
}

// Tables that a filtration builds in its first run belong to the filtration and count towards its
// own budget. The budget of the run also limits them.
TEST(MemoryBudgets, OfARunBoundsWhatACubicalFiltrationMakesLate) {
  const Image image = Generator(3).image({9, 8, 7}, false);
  for (const Engine engine : kListCells) {
    SCOPED_TRACE(engine.name());
    const Options options{.max_dim = 0, .engine = engine};
    RunContext home;
    const Cubical cubical(image, {}, home);
    const std::size_t voxels = home.memory.used();
    const std::size_t table = 17 * 15 * 13 * 4 + entering(image) * 8;
    {
      LimitedContext run(table - 1);
      expect_error(ErrorKind::resource, "memory limit",
                   [&] { persistence(cubical, options, run); });
      EXPECT_EQ(run.memory.used(), 0U);
      EXPECT_EQ(home.memory.used(), voxels) << "nothing was made";
    }
    std::vector<Bar> bars;
    {
      RunContext run;
      bars = bars_of(persistence(cubical, options, run));
      EXPECT_GE(run.memory.peak(), table);
      EXPECT_EQ(run.memory.used(), 0U);
      EXPECT_GE(home.memory.used(), voxels + table);
      EXPECT_LE(home.memory.used(), voxels + table + 100) << "headers of blocks";
    }  // the context of the first run ends here
    EXPECT_EQ(bars, bars_of(persistence(cubical, options)));
    EXPECT_EQ(bars, bars_of(persistence(Cubical(image), options)));
  }
}

TEST(MemoryBudgets, OfTheConstructionBoundsWhatACubicalFiltrationMakesLate) {
  const Image image = Generator(3).image({9, 8, 7}, false);
  LimitedContext home(image.values.bytes() + 1000);
  const Cubical cubical(image, {}, home);
  expect_error(ErrorKind::resource, "memory limit",
               [&] { persistence(cubical, {.engine = Engine::twist}); });
  expect_error(ErrorKind::resource, "memory limit",
               [&] { cubical.for_each_cell(0, [](const Cubical::Cell&) {}); });
  home.memory.set_limit(MemoryBudget::kUnlimited);
  std::size_t count = 0;
  cubical.for_each_cell(0, [&](const Cubical::Cell&) { ++count; });
  EXPECT_EQ(count, entering(image)) << "it can be tried again";
}

TEST(MemoryBudgets, HoldForExplicitComplexes) {
  Generator random(3);
  const SimplexList simplices = random.simplices(40, 3, 60, false);
  const std::vector<double> values(40, 0.0);
  for (const std::size_t limit : {0U, 1000U, 20000U, 40000U, 80000U, 1000000U}) {
    LimitedContext context(limit);
    const auto stays_below = [&](auto&& build) {
      const bool is_short =
          fails_with(ErrorKind::resource, [&] { persistence(build(), {}, context); });
      EXPECT_TRUE(is_short || limit > 1000U);
      EXPECT_FALSE(is_short && limit >= 1000000U);
      EXPECT_LE(context.memory.peak(), limit);
      EXPECT_EQ(context.memory.used(), 0U);
    };
    stays_below([&] { return ExplicitComplex::from_simplices(simplices, {}, context); });
    stays_below([&] { return lower_star(simplices, values, {}, context); });
  }
}

TEST(MemoryBudgets, WithinAnotherBothLimitsHold) {
  // A block of 16 k + 8 bytes takes 16 k + 16, because it has a header.
  MemoryBudget outer(1024);
  {
    MemoryBudget inner(outer);
    EXPECT_EQ(inner.limit(), MemoryBudget::kUnlimited);
    EXPECT_EQ(inner.left(), 1024U);
    inner.set_limit(608);
    void* a = inner.allocate(504, 8);
    EXPECT_EQ(inner.used(), 512U);
    EXPECT_EQ(outer.used(), 512U);
    expect_error(ErrorKind::resource, "memory limit of 608", [&] { (void)inner.allocate(97, 8); });
    expect_error(ErrorKind::resource, "memory limit of 608", [&] { inner.require(97); });
    EXPECT_EQ(outer.used(), 512U) << "a refusal changes nothing";
    EXPECT_EQ(inner.used(), 512U);
    EXPECT_EQ(inner.left(), 96U);
    void* b = outer.allocate(456, 8);
    EXPECT_EQ(inner.left(), 48U) << "of the outer one";
    EXPECT_EQ(inner.used(), 512U);
    expect_error(ErrorKind::resource, "memory limit of 1", [&] { (void)inner.allocate(49, 8); });
    expect_error(ErrorKind::resource, "memory limit of 1", [&] { inner.require(49); });
    EXPECT_EQ(inner.used(), 512U);
    EXPECT_EQ(outer.used(), 976U);
    EXPECT_NO_THROW(inner.require(48));
    {
      const MemoryClaim claim(inner, 48);
      EXPECT_EQ(outer.used(), 1024U);
    }
    MemoryBudget innermost(inner);
    void* c = innermost.allocate(40, 8);
    EXPECT_EQ(outer.used(), 1024U);
    innermost.deallocate(c, 40, 8);
    inner.deallocate(a, 504, 8);
    EXPECT_EQ(inner.used(), 0U);
    EXPECT_EQ(outer.used(), 464U);
    outer.deallocate(b, 456, 8);
    EXPECT_EQ(inner.peak(), 560U);
  }
  EXPECT_EQ(outer.used(), 0U);
  EXPECT_EQ(outer.peak(), 1024U);
}

TEST(RunContexts, CountWithinAnother) {
  LimitedContext outer(1 << 20);
  {
    const RunContext inner(outer.memory);
    const Rips rips(Generator(3).points(50, 3, false), {}, inner);
    persistence(rips, {}, inner);
    EXPECT_GT(inner.memory.used(), 0U);
    EXPECT_EQ(outer.memory.used(), inner.memory.used());
    EXPECT_GE(outer.memory.peak(), inner.memory.peak());
    expect_error(ErrorKind::resource, "memory limit",
                 [&] { persistence(rips, {.max_dim = 3, .engine = Engine::standard}, inner); });
    EXPECT_EQ(outer.memory.used(), inner.memory.used());
  }
  EXPECT_EQ(outer.memory.used(), 0U);
}

TEST(MemoryBudgets, CountWhatComesFromElsewhere) {
  MemoryBudget budget(1000);
  {
    const MemoryClaim claim(budget, 600);
    EXPECT_EQ(budget.used(), 600U);
    expect_error(ErrorKind::resource, "memory limit", [&] { MemoryClaim(budget, 401); });
  }
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_EQ(budget.peak(), 600U);
}

// ---- run contexts

using Clock = std::chrono::steady_clock;

// Points that keep every engine busy for many seconds if it computes more than H0.
Points long_job(Engine engine) {
  return Generator(1).points(engine == Engine::cohomology ? 400 : 90, 6, false);
}

TEST(RunContexts, AStopRequestEndsALongJobSoon) {
  for (const Engine engine : {Engine::standard, Engine::twist, Engine::cohomology}) {
    SCOPED_TRACE(engine.name());
    const Rips rips(long_job(engine), {.threshold = 10});
    rips.graph(RipsForm::distinct_edges);
    StoppableContext context;
    Clock::time_point asked;
    std::thread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      asked = Clock::now();
      context.request_stop();
    });
    const Options options{.max_dim = 3, .field = 3, .engine = engine, .collapse = Collapse::off};
    expect_error(ErrorKind::cancelled, "stopped", [&] { persistence(rips, options, context); });
    const auto late = Clock::now();
    stopper.join();
    EXPECT_LT(late - asked, test::patience(0.5));
  }
}

TEST(RunContexts, AStopRequestedBeforehandStopsEverything) {
  StoppedContext context;
  const Points points = circle(5);
  const Rips rips(points);
  for (const RipsForm form : {RipsForm::edges, RipsForm::distinct_edges, RipsForm::forest}) {
    expect_error(ErrorKind::cancelled, "stopped", [&] { rips.graph(form, context); });
    expect_error(ErrorKind::cancelled, "stopped",
                 [&] { Rips(points, {.threshold = 1}).graph(form, context); });
    rips.graph(form);
  }
  rips.graph(RipsForm::points);
  expect_error(ErrorKind::cancelled, "stopped", [&] {
    Cubical cubical(Image{{2}, {0, 1}}, {}, context);
  });
  const Cubical image(Image{{2}, {0, 1}});
  for (const auto& engine : detail::engine_facts()) {
    expect_error(ErrorKind::cancelled, "stopped", [&] {
      if (engine.id == Engine::gradient)
        persistence(image, {.engine = engine.id}, context);
      else
        persistence(rips, {.max_dim = 0, .engine = engine.id}, context);
    });
  }
}

TEST(RunContexts, WhatACubicalFiltrationMakesLateIsStoppedAndReported) {
  const Image image = Generator(3).image({90, 80}, false);
  for (const Engine engine : kListCells) {
    SCOPED_TRACE(engine.name());
    RunContext home;
    const Cubical cubical(image, {}, home);
    const std::size_t voxels = home.memory.used();
    StoppableContext run;
    std::string stage;
    run.on_progress = [&](const Progress& progress) {
      stage = progress.stage;
      run.request_stop();
    };
    // Reports are at least 100 ms apart.
    std::this_thread::sleep_for(std::chrono::milliseconds(110));
    expect_error(ErrorKind::cancelled, "stopped",
                 [&] { persistence(cubical, {.max_dim = 0, .engine = engine}, run); });
    EXPECT_EQ(stage, "cells");
    EXPECT_EQ(home.memory.used(), voxels) << "nothing was made";
  }
}

TEST(RunContexts, AThreadThatWaitsForACubicalFiltrationCanBeStopped) {
  const Cubical cubical(Generator(3).image({30, 30}, false));
  std::atomic<bool> is_making = false, may_go_on = false;
  RunContext slow;
  slow.on_progress = [&](const Progress&) {
    is_making = true;
    while (!may_go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  std::this_thread::sleep_for(std::chrono::milliseconds(110));  // reports are at least 100 ms apart
  std::thread maker([&] { cubical.prepare(slow); });
  while (!is_making) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  StoppableContext waiting;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    waiting.request_stop();
  });
  expect_error(ErrorKind::cancelled, "stopped", [&] { cubical.prepare(waiting); });
  stopper.join();
  may_go_on = true;
  maker.join();
  EXPECT_NO_THROW(cubical.prepare(RunContext()));
}

TEST(RunContexts, SlowStepsAreReportedAndStopped) {
  StoppableContext context;
  int reports = 0;
  context.on_progress = [&](const Progress&) { ++reports; };
  Ticker ticker(context, "slow");
  for (int step = 0; step < 100; ++step) ticker.tick(1000);  // quick steps come first
  const auto step = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ticker.tick(400);
  };
  for (int i = 0; i < 40 && reports < 2; ++i) step();
  EXPECT_EQ(reports, 2);
  context.request_stop();
  expect_error(ErrorKind::cancelled, "stopped", [&] {
    for (int i = 0; i < 4; ++i) step();
  });
}

TEST(RunContexts, ManyShortStagesAreReported) {
  RunContext context;
  int reports = 0;
  context.on_progress = [&](const Progress&) { ++reports; };
  for (int stage = 0; stage < 20; ++stage) {
    Ticker ticker(context, "short");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ticker.tick();
  }
  EXPECT_GE(reports, 2);
}

TEST(RunContexts, ProgressComesAtMostTenTimesASecond) {
  StoppableContext context;
  std::vector<Clock::time_point> calls;
  context.on_progress = [&](const Progress& progress) {
    calls.push_back(Clock::now());
    EXPECT_FALSE(progress.stage.empty());
    if (progress.total > 0) {
      EXPECT_LE(progress.done, progress.total);
    }
    if (calls.size() == 5) context.request_stop();
  };
  expect_error(ErrorKind::cancelled, "stopped", [&] {
    const Rips rips(long_job(Engine::cohomology), {.threshold = 10}, context);
    persistence(rips, {.max_dim = 3, .engine = Engine::cohomology, .collapse = Collapse::off},
                context);
  });
  ASSERT_EQ(calls.size(), 5U);
  for (std::size_t i = 1; i < calls.size(); ++i)
    EXPECT_GE(calls[i] - calls[i - 1], std::chrono::milliseconds(95));
}

}  // namespace
}  // namespace ph::test
