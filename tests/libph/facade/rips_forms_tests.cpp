// SPDX-License-Identifier: MIT
// Forms of a Rips filtration. Each form is made only once, when a caller first requests it. If this
// attempt fails, the next request tries again.
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "ph/estimate.hpp"
#include "ph/loops.hpp"
#include "ph/merge_tree.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

constexpr std::array kForms{RipsForm::edges, RipsForm::distinct_edges, RipsForm::forest,
                            RipsForm::points};

Points some_points(Index n = 60) { return Generator(1).points(n, 2, true); }

DistanceMatrix some_distances(Index n = 30) { return Generator(2).distances(n, true); }

std::array<const RipsGraph*, kForms.size()> all_forms(const Rips& rips) {
  std::array<const RipsGraph*, kForms.size()> made{};
  for (std::size_t i = 0; i < kForms.size(); ++i) made[i] = &rips.graph(kForms[i]);
  return made;
}

TEST(RipsForms, AreWhatTheySay) {
  const Rips rips(Points{{0}, {2}, {0}, {1}});
  EXPECT_EQ(rips.size(), 4);
  EXPECT_EQ(rips.graph(RipsForm::edges).size(), 4);
  EXPECT_EQ(rips.graph(RipsForm::edges).edge_count(), 4U) << "within the radius 1";
  EXPECT_EQ(rips.graph(RipsForm::distinct_edges).size(), 3);
  EXPECT_EQ(rips.graph(RipsForm::distinct_edges).edge_count(), 2U);
  EXPECT_EQ(rips.graph(RipsForm::distinct_edges).name(2), 3);
  EXPECT_EQ(rips.graph(RipsForm::forest).size(), 4);
  EXPECT_TRUE(rips.graph(RipsForm::forest).is_forest());
  ASSERT_TRUE(rips.graph(RipsForm::points).points_alone());
  EXPECT_EQ(rips.graph(RipsForm::points).points_alone()->rows(), 3);
}

TEST(RipsForms, AreMadeOnce) {
  const Rips rips(some_points());
  Rips before = rips;
  const auto made = all_forms(rips);
  EXPECT_EQ(all_forms(rips), made);
  EXPECT_EQ(all_forms(before), made) << "copies share what is made after them";
  const Rips after = rips;
  EXPECT_EQ(all_forms(after), made);
  const Rips moved = std::move(before);
  EXPECT_EQ(all_forms(moved), made);
}

TEST(RipsForms, ComponentsLoopsAndTreeShareThem) {
  RunContext home;
  const Rips rips(some_points(), {}, home);
  const std::size_t input = home.memory.used();
  EXPECT_EQ(input, 60U * 2 * sizeof(double));
  persistence(rips, {.max_dim = 0});
  const std::size_t with_forest = home.memory.used();
  EXPECT_GT(with_forest, input);
  merge_tree(rips);
  EXPECT_EQ(home.memory.used(), with_forest) << "it has the forest already";
  persistence(rips);
  const std::size_t with_edges = home.memory.used();
  EXPECT_GT(with_edges, with_forest);
  persistence(rips);
  persistence(rips, {.max_dim = 0});
  merge_tree(rips);
  EXPECT_EQ(home.memory.used(), with_edges);
}

// ---- threads

TEST(RipsForms, OfOneRipsForManyThreads) {
  const Points points = some_points(40);
  const auto cycles = Options{.representatives = Representatives::cycles};
  const std::vector<std::function<std::string(const Rips&)>> tasks{
      [](const Rips& rips) {
        return std::to_string(persistence(rips, {.max_dim = 0, .min_persistence = -1}).size());
      },
      [](const Rips& rips) { return std::to_string(persistence(rips).size()); },
      [](const Rips& rips) {
        return std::to_string(persistence(rips, {.engine = Engine::beta_skeleton}).size());
      },
      [](const Rips& rips) {
        return std::to_string(persistence(rips, {.max_dim = 2, .min_persistence = -1}).size());
      },
      [](const Rips& rips) { return std::to_string(merge_tree(rips).merges.size()); },
      [](const Rips& rips) { return std::to_string(*facts(rips, plan(rips)).edges); },
      [](const Rips& rips) { return std::to_string(estimate(rips, {.max_dim = 2}).bytes_high); },
      [&](const Rips& rips) {
        return std::to_string(loops(rips, persistence(rips, cycles), cycles).size());
      }};
  std::vector<std::string> expected;
  for (const auto& task : tasks) expected.push_back(task(Rips(points)));
  for (int round = 0; round < 20; ++round) {
    const Rips rips = round % 2 == 0 ? Rips(points) : Rips::borrowed(points);
    std::vector<std::string> found(tasks.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < tasks.size(); ++i)
      threads.emplace_back([&tasks, &found, copy = rips, i] { found[i] = tasks[i](copy); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, expected);
  }
}

/// A metric that signals that it has been called, and waits until it may answer.
struct Gate {
  std::atomic<bool> is_asked = false, may_answer = false;
};
struct Slow {
  Gate* gate;
  Index size() const { return 9; }
  double operator()(Index i, Index j) const {
    gate->is_asked = true;
    while (!gate->may_answer) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::abs(static_cast<double>(i - j));
  }
};

void wait_for(const std::atomic<bool>& flag) {
  while (!flag) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(RipsForms, AThreadThatWaitsCanBeStopped) {
  Gate gate;
  const Rips rips(Slow{&gate});
  std::thread maker([&] { rips.graph(RipsForm::edges); });
  wait_for(gate.is_asked);
  StoppableContext waiting;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    waiting.request_stop();
  });
  expect_error(ErrorKind::cancelled, "stopped", [&] { rips.graph(RipsForm::edges, waiting); });
  stopper.join();
  gate.may_answer = true;
  maker.join();
  EXPECT_EQ(rips.graph(RipsForm::edges, waiting).edge_count(), 26U) << "it is there";
}

TEST(RipsForms, AThreadThatWaitsGoesOnWhereTheFirstWasStopped) {
  Gate gate;
  const Rips rips(Slow{&gate});
  std::stop_source source;
  bool is_stopped = false;
  std::thread maker([&] {
    RunContext context;
    context.stop = source.get_token();
    try {
      rips.graph(RipsForm::edges, context);
    } catch (const Error& error) {
      is_stopped = error.kind() == ErrorKind::cancelled;
    }
  });
  wait_for(gate.is_asked);
  std::size_t edges = 0;
  std::thread waiter([&] { edges = rips.graph(RipsForm::edges).edge_count(); });
  source.request_stop();
  gate.may_answer = true;
  maker.join();
  waiter.join();
  EXPECT_TRUE(is_stopped);
  EXPECT_EQ(edges, 26U);
}

// ---- stops and memory

TEST(RipsForms, AreMadeAgainAfterAStop) {
  RunContext home;
  const Rips rips(some_points(), {.subsample = GreedyLimits{.points = 20}}, home);
  const std::size_t input = home.memory.used();
  StoppedContext stopped;
  for (const RipsForm form : {RipsForm::edges, RipsForm::distinct_edges, RipsForm::forest}) {
    expect_error(ErrorKind::cancelled, "stopped", [&] { rips.graph(form, stopped); });
    EXPECT_EQ(home.memory.used(), input) << "nothing stays";
  }
  expect_error(ErrorKind::cancelled, "stopped", [&] { persistence(rips, {}, stopped); });
  expect_error(ErrorKind::cancelled, "stopped", [&] { merge_tree(Rips(some_points()), stopped); });
  for (const RipsForm form : kForms) EXPECT_LE(rips.graph(form).size(), 20);
  EXPECT_NO_THROW(rips.graph(RipsForm::edges, stopped)) << "it is there";
}

// The metric requests a stop in the middle of the computation.
TEST(RipsForms, AreMadeAgainAfterAStopInTheMiddle) {
  struct Stopping {
    std::stop_source* source;
    Index size() const { return 300; }
    double operator()(Index i, Index j) const {
      if (i == 200 || j == 200) source->request_stop();
      return std::abs(static_cast<double>(i - j));
    }
  };
  for (const RipsForm form : {RipsForm::edges, RipsForm::forest}) {
    std::stop_source source;
    RunContext home, call;
    call.stop = source.get_token();
    const Rips rips(Stopping{&source}, {.threshold = 5}, home);
    expect_error(ErrorKind::cancelled, "stopped", [&] { rips.graph(form, call); });
    EXPECT_EQ(home.memory.used(), 0U);
    EXPECT_EQ(rips.graph(form).edge_count(), form == RipsForm::forest ? 299U : 1485U);
  }
}

TEST(RipsForms, AreMadeAgainWithMoreMemory) {
  for (const RipsForm form : {RipsForm::edges, RipsForm::distinct_edges, RipsForm::forest}) {
    RunContext home;
    const Rips rips(some_points(300), {}, home);
    const std::size_t input = home.memory.used();
    {
      LimitedContext small(1000);
      expect_error(ErrorKind::resource, "memory limit", [&] { rips.graph(form, small); });
      EXPECT_EQ(home.memory.used(), input) << "nothing stays";
      EXPECT_EQ(small.memory.used(), 0U);
    }
    home.memory.set_limit(input + 1000);
    expect_error(ErrorKind::resource, "memory limit", [&] { rips.graph(form); });
    EXPECT_EQ(home.memory.used(), input);
    home.memory.set_limit(MemoryBudget::kUnlimited);
    LimitedContext large(std::size_t{1} << 26);
    EXPECT_GT(rips.graph(form, large).edge_count(), 0U);
    EXPECT_GT(home.memory.used(), input);
    EXPECT_EQ(large.memory.used(), 0U) << "a form counts where the filtration does";
  }
}

// ---- contexts

TEST(RipsForms, OutliveTheContextOfTheCall) {
  const Points points = some_points();
  const Rips rips(points, {.dtm_neighbours = 3, .subsample = GreedyLimits{.points = 40}});
  const Rips plain(points);
  auto call = std::make_unique<RunContext>();
  call->memory.set_limit(std::size_t{1} << 27);
  call->threads = 2;
  std::stop_source source;
  call->stop = source.get_token();
  call->on_progress = [text = std::make_shared<std::string>("told")](const Progress&) {
    EXPECT_EQ(*text, "told");
  };
  for (const RipsForm form : kForms) plain.graph(form, *call);
  for (const RipsForm form : {RipsForm::edges, RipsForm::forest}) rips.graph(form, *call);
  source.request_stop();
  call.reset();
  // The context of the calls that made the forms no longer exists. Data that engines add to a form
  // now count towards the budget of the form.
  for (const Rips& used : {rips, plain})
    for (const Engine engine : {Engine::edge_links, Engine::cohomology, Engine::twist})
      EXPECT_GT(persistence(used, {.engine = engine}).size(), 0U);
  EXPECT_EQ(pairs_of(persistence(plain, {.engine = Engine::beta_skeleton})),
            pairs_of(persistence(plain)));
  EXPECT_EQ(merge_tree(plain).merges.size(), 59U);
}

TEST(RipsForms, CountInTheContextOfTheConstructor) {
  RunContext home;
  const auto expect_counted = [&](const Rips& rips, std::size_t input) {
    EXPECT_EQ(home.memory.used(), input);
    std::size_t used = input;
    for (const RipsForm form : {RipsForm::edges, RipsForm::forest}) {
      rips.graph(form);
      EXPECT_GT(home.memory.used(), used);
      used = home.memory.used();
    }
    const Rips copy = rips, other = rips.with({.threshold = 1}, home);
    EXPECT_EQ(home.memory.used(), used) << "shared";
  };
  const DistanceMatrix distances = some_distances();
  const Points points = some_points();
  expect_counted(Rips(points, {}, home), 60U * 2 * sizeof(double));
  EXPECT_EQ(home.memory.used(), 0U);
  expect_counted(Rips::borrowed(points, {}, home), 0);
  EXPECT_EQ(home.memory.used(), 0U);
  expect_counted(Rips(distances, {}, home), 0);  // the distances are shared with the caller
  EXPECT_EQ(home.memory.used(), 0U);
  const SparseDistances sparse(3, {{0, 1, 1}, {1, 2, 1}});
  expect_counted(Rips(sparse, {}, home), 0);
  EXPECT_EQ(home.memory.used(), 0U);
  expect_counted(Rips(PointMetric(points), {}, home), 0);
  EXPECT_EQ(home.memory.used(), 0U);
  home.memory.set_limit(100);
  expect_error(ErrorKind::resource, "memory limit", [&] { Rips(points, {}, home); });
  EXPECT_NO_THROW(Rips(distances, {}, home));
  EXPECT_NO_THROW(Rips::borrowed(points, {}, home));
  EXPECT_EQ(home.memory.used(), 0U);
}

// ---- the input

TEST(RipsInputs, AreSharedBorrowedOrMoved) {
  Points points = some_points();
  const double* numbers = points.data();
  const Rips borrowed = Rips::borrowed(points);
  EXPECT_EQ(borrowed.points()->row(0), numbers);
  EXPECT_EQ(borrowed.with({.threshold = 1}).points()->row(0), numbers);
  const Rips copied(points);
  EXPECT_NE(copied.points()->row(0), numbers);
  const PointsView view = points;
  EXPECT_NE(Rips(view).points()->row(0), numbers);
  const auto expected = pairs_of(persistence(borrowed));
  const Rips moved(std::move(points));
  EXPECT_EQ(moved.points()->row(0), numbers);
  EXPECT_EQ(pairs_of(persistence(moved)), expected);
  EXPECT_EQ(pairs_of(persistence(copied)), expected);
  EXPECT_EQ(copied.with({}).points()->row(0), copied.points()->row(0));
  EXPECT_FALSE(Rips(some_distances()).points());
}

TEST(RipsInputs, DistancesAreShared) {
  const DistanceMatrix distances(3, {1, 2, 3}, {0, 0.5, 0.25});
  const DistanceMatrix copy = distances;
  EXPECT_EQ(copy.births().data(), distances.births().data());
  const SparseDistances sparse(3, {{0, 1, 1}, {1, 2, 1}});
  const SparseDistances other = sparse;
  EXPECT_EQ(other.edges().data(), sparse.edges().data());
  // The distances outlive the object that was passed.
  auto first = std::make_unique<DistanceMatrix>(some_distances());
  const DistanceMatrix second = *first;
  const Rips rips(*first);
  first.reset();
  EXPECT_EQ(second(4, 2), some_distances()(4, 2));
  EXPECT_EQ(pairs_of(persistence(rips)), pairs_of(persistence(Rips(some_distances()))));
}

TEST(RipsInputs, ForgottenTheyLeaveWhatWasMade) {
  RunContext home;
  Rips rips(some_points(), {}, home);
  const Rips copy = rips;
  const RunPlan loops = plan(rips), components = plan(rips, {.max_dim = 0});
  ASSERT_EQ(loops.form, RipsForm::distinct_edges);
  const auto expected = pairs_of(run(rips, loops));
  const RipsGraph* made = &rips.graph(RipsForm::distinct_edges);
  const std::size_t used = home.memory.used();
  rips.forget_input();
  EXPECT_EQ(home.memory.used(), used - 60 * 2 * sizeof(double));
  for (const Rips* left : {&static_cast<const Rips&>(rips), &copy}) {
    EXPECT_EQ(&left->graph(RipsForm::distinct_edges), made);
    EXPECT_EQ(pairs_of(run(*left, loops)), expected);
    EXPECT_EQ(left->size(), 60);
    EXPECT_FALSE(left->points());
    EXPECT_TRUE(left->has_form(RipsForm::distinct_edges));
    EXPECT_FALSE(left->has_form(RipsForm::forest));
    for (const RipsForm form : {RipsForm::edges, RipsForm::forest, RipsForm::points})
      expect_error(ErrorKind::usage, "the input was freed", [&] { left->graph(form); });
    expect_error(ErrorKind::usage, "the input was freed", [&] { left->sample(); });
    expect_error(ErrorKind::usage, "the input was freed", [&] { left->with({}); });
    expect_error(ErrorKind::usage, "the input was freed", [&] { run(*left, components); });
  }
  // The form `points alone` keeps the points.
  Rips alone(some_points());
  const RunPlan by_points = plan(alone, {.engine = Engine::beta_skeleton});
  build(alone, by_points);
  alone.forget_input();
  EXPECT_EQ(pairs_of(run(alone, by_points)), expected);
}

/// A metric that holds a token, which shows whether any object still holds the metric.
struct Held {
  std::shared_ptr<int> token = std::make_shared<int>(0);
  Index size() const { return 9; }
  double operator()(Index i, Index j) const { return std::abs(static_cast<double>(i - j)); }
};

TEST(RipsInputs, AreGivenBackAtTheLastUse) {
  const auto held = [](std::weak_ptr<int>& token) {
    Held metric;
    token = metric.token;
    return metric;
  };
  std::weak_ptr<int> token;
  Rips last(held(token));
  EXPECT_TRUE(last.is_only_copy());
  const Barcode expected = persistence(last);
  EXPECT_FALSE(token.expired()) << "it may be asked again";
  EXPECT_EQ(first_difference(persistence(std::move(last)), expected), "");
  EXPECT_TRUE(token.expired());

  Rips shared(held(token));
  const Rips copy = shared;
  EXPECT_FALSE(shared.is_only_copy());
  EXPECT_EQ(first_difference(persistence(std::move(shared)), expected), "");
  EXPECT_FALSE(token.expired());
  EXPECT_EQ(first_difference(persistence(copy), expected), "");

  Rips asked(held(token));
  {
    const Rips other = asked.with({.threshold = 3});
    EXPECT_FALSE(asked.is_only_copy()) << "another question about the same data";
  }
  AnyComplex any(std::move(asked));
  const RunPlan planned = plan(any);
  EXPECT_EQ(first_difference(run(any, planned), expected), "");
  EXPECT_FALSE(token.expired());
  EXPECT_EQ(first_difference(run(std::move(any), planned), expected), "");
  EXPECT_TRUE(token.expired());
}

TEST(RipsInputs, CanBeAskedOtherQuestions) {
  const Points points = some_points();
  const Rips rips(points);
  for (const RipsOptions& options :
       {RipsOptions{.threshold = 1}, RipsOptions{.distance = PointDistance::manhattan},
        RipsOptions{.vertices = {1, 4, 7, 20, 21}}, RipsOptions{.dtm_neighbours = 4},
        RipsOptions{.approximation = 0.5}, RipsOptions{.merge_equal_points = false}})
    EXPECT_EQ(pairs_of(persistence(rips.with(options))),
              pairs_of(persistence(Rips(points, options))));
  EXPECT_EQ(rips.with({.threshold = 1}).options().threshold, 1);
  EXPECT_EQ(rips.options().threshold, std::nullopt);
  expect_error(ErrorKind::usage, "threshold", [&] { rips.with({.threshold = -1}); });
  const Rips graph(RipsGraph::of_edges(3, {}, {}, default_context()));
  expect_error(ErrorKind::usage, "Rips:", [&] { graph.with({}); });
}

// ---- forms that do not exist

TEST(RipsForms, ThatAnInputCannotHaveAreRefused) {
  const auto refused = [](const Rips& rips, const std::string& why, std::vector<RipsForm> forms) {
    for (const RipsForm form : kForms) {
      const bool is_refused = std::ranges::find(forms, form) != forms.end();
      EXPECT_EQ(rips.has_form(form), !is_refused);
      if (is_refused)
        expect_error(ErrorKind::usage, why, [&] { rips.graph(form); });
      else
        EXPECT_NO_THROW(rips.graph(form));
    }
  };
  const std::vector of_points{RipsForm::distinct_edges, RipsForm::points};
  refused(Rips(some_points()), "", {});
  refused(Rips(some_distances()), "of distances", of_points);
  refused(Rips(SparseDistances(2, {{0, 1, 1}})), "of distances", of_points);
  refused(Rips(Held{}), "of distances", of_points);
  refused(Rips(some_points(), {.approximation = 0.5}), "approximated",
          {RipsForm::forest, RipsForm::points});
  refused(Rips(Held{}, {.approximation = 0.5}), "approximated",
          {RipsForm::distinct_edges, RipsForm::forest, RipsForm::points});
  refused(Rips(RipsGraph::of_edges(2, {}, {}, default_context())), "of a graph",
          {RipsForm::distinct_edges, RipsForm::forest, RipsForm::points});
  refused(Rips(RipsGraph::forest_of_edges(2, {}, {}, default_context())), "of a graph",
          {RipsForm::edges, RipsForm::distinct_edges, RipsForm::points});
}

TEST(RipsForms, OfNothing) {
  for (const Rips& rips : {Rips(Points()), Rips(Points(0, 3)),
                           Rips(Points(0, 3), {.subsample = GreedyLimits{.points = 3}}),
                           Rips(Points(0, 3), {.dtm_neighbours = 1})}) {
    for (const RipsForm form : kForms) EXPECT_EQ(rips.graph(form).size(), 0);
    EXPECT_TRUE(persistence(rips).empty());
    EXPECT_TRUE(persistence(rips, {.max_dim = 0}).empty());
  }
}

}  // namespace
}  // namespace ph::test
