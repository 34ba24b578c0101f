// SPDX-License-Identifier: MIT
// Compares the loops of bars of Rips filtrations with an independent oracle.
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/libph/loops/loop_oracle.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/rips_graphs.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

double total_of(const BarLoops& of_bar) {
  double sum = 0;
  for (const Loop& loop : of_bar.loops) sum += loop.length.value_or(kInfinity);
  return sum;
}

struct Counts {
  int bars = 0, shortest = 0, shorter = 0, locally = 0;
};

/// Checks everything that ph/loops.hpp promises about the loops of a filtration.
void check_loops(const Rips& rips, const Options& asked, Counts& counts) {
  Options options = asked;
  options.representatives = Representatives::cycles;
  const std::int64_t p = options.field;
  const Barcode bars = persistence(rips, options);
  const auto plain = loops(rips, bars, options, false);
  const auto tight = loops(rips, bars, options, true);
  ASSERT_EQ(plain.size(), bars.size());
  ASSERT_EQ(tight.size(), bars.size());
  const FlagComplex complex(planned_graph(rips, options), p);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    SCOPED_TRACE("bar " + std::to_string(i));
    if (bars[i].dim != 1) {
      EXPECT_TRUE(plain[i].loops.empty() && tight[i].loops.empty());
      continue;
    }
    const EdgeChain chain = edges_of(bars.representative(i), p);
    EXPECT_EQ(plain[i].tightness, Tightness::none);
    EXPECT_EQ(sum_of(plain[i].loops, p), chain);
    check_form(plain[i].loops, 1, p);
    if (p == 2) {
      std::size_t steps = 0;
      for (const Loop& loop : plain[i].loops) steps += loop.numbers.size();
      EXPECT_EQ(steps, chain.size()) << "an edge is in two walks";
    }

    const double birth = bars[i].birth, death = bars[i].death;
    if (!(birth < death)) {
      EXPECT_EQ(tight[i].loops, plain[i].loops);
      continue;
    }
    ++counts.bars;
    const auto birth_ends = bars.birth_cell(i).numbers;
    const std::size_t born = *complex.place(birth_ends[0], birth_ends[1]);
    for (const Loop& loop : tight[i].loops) {
      double length = 0;
      for (std::size_t k = 0; k < loop.numbers.size(); ++k) {
        const auto edge =
            complex.place(loop.numbers[k], loop.numbers[(k + 1) % loop.numbers.size()]);
        ASSERT_TRUE(edge) << "no edge";
        EXPECT_LE(complex.edges[*edge].value, birth);
        if (options.collapse == Collapse::off) {
          EXPECT_LE(*edge, born);
        }
        length += complex.edges[*edge].value;
      }
      EXPECT_NEAR(*loop.length, length, 1e-9);
    }
    check_form(tight[i].loops, 1, p);
    for (const Loop& loop : tight[i].loops) {
      // Checks that no vertex of the loop can be left out.
      const auto& v = loop.numbers;
      for (std::size_t k = 0; k < v.size() && v.size() > 3; ++k) {
        const auto first = complex.place(v[k], v[(k + 1) % v.size()]),
                   second = complex.place(v[(k + 1) % v.size()], v[(k + 2) % v.size()]),
                   both = complex.place(v[k], v[(k + 2) % v.size()]);
        if (first == born || second == born || !both || *both >= born) continue;
        EXPECT_GT(complex.edges[*both].value,
                  complex.edges[*first].value + complex.edges[*second].value - 1e-9);
      }
    }

    const EdgeRow given = complex.row_of(chain), found = complex.row_of(sum_of(tight[i].loops, p));
    EXPECT_EQ(found[born], given[born]);
    EdgeRow difference(given.size());
    for (std::size_t k = 0; k < given.size(); ++k) difference[k] = modulo(found[k] - given[k], p);
    const auto is_before = [&](const FlagComplex::Edge& e) { return e.value < death; };
    const auto is_there = [&](const FlagComplex::Edge& e) { return e.value <= death; };
    EXPECT_TRUE(is_in_span(complex.boundaries(is_before), difference, p)) << "not homologous";
    EXPECT_FALSE(is_in_span(complex.boundaries(is_before), found, p)) << "dies too early";
    if (!bars[i].is_infinite()) {
      EXPECT_TRUE(is_in_span(complex.boundaries(is_there), found, p)) << "does not die";
    }
    EXPECT_LE(total_of(tight[i]), total_of(plain[i]) + 1e-9);
    counts.shorter += total_of(tight[i]) < total_of(plain[i]) - 1e-9 ? 1 : 0;

    std::vector<bool> may_use;
    for (std::size_t k = 0; k < complex.edges.size(); ++k)
      may_use.push_back(options.collapse == Collapse::off
                            ? k < born
                            : k != born && complex.edges[k].value <= birth);
    bool gave_up = false;
    const auto least =
        shortest_walk(complex, given, born, may_use, cocycles_of(complex, is_before), gave_up);
    if (gave_up) continue;
    ASSERT_NE(tight[i].tightness, Tightness::none);
    EXPECT_EQ(tight[i].tightness == Tightness::shortest, least.has_value());
    if (!least) {
      ++counts.locally;
      continue;
    }
    ++counts.shortest;
    if (tight[i].loops.size() == 1)
      EXPECT_NEAR(total_of(tight[i]), *least, 1e-9);
    else
      EXPECT_LE(total_of(tight[i]), *least + 1e-9);
  }
}

constexpr std::int64_t kFields[] = {2, 3, 5};

Options options_of(Generator& random) {
  Options options;
  options.field = kFields[random.integer(0, 2)];
  options.max_dim = random.integer(1, 2);
  options.collapse = static_cast<Collapse>(random.integer(0, 2));
  options.min_persistence = random.integer(0, 3) == 0 ? 0.1 : 0;
  return options;
}

TEST(Loops, AreShortestInRandomDistances) {
  Counts counts;
  for_each_seed(1600, [&](Generator& random, bool ties, std::int64_t) {
    RipsOptions rips;
    if (random.coin()) rips.threshold = ties ? random.integer(1, 3) : random.real();
    const Rips complex(random.distances(random.integer(4, 10), ties), rips);
    check_loops(complex, options_of(random), counts);
  });
  // Checks that the inputs were not trivial.
  EXPECT_TRUE(is_enough(counts.bars, 1500)) << counts.bars;
  EXPECT_TRUE(is_enough(counts.shortest, 1000)) << counts.shortest;
  EXPECT_TRUE(is_enough(counts.shorter, 50)) << counts.shorter;
}

// The shortest walk passes three vertices twice. Splitting its chain edge by edge would give longer
// loops.
TEST(Loops, AreNoLongerThanTheirWalk) {
  const std::vector<double> lower{
      0.369, 0.679, 0.677, 0.695, 0.476, 0.334, 0.151, 0.415, 0.607, 0.956, 0.194,
      0.546, 0.625, 0.287, 0.804, 0.829, 0.049, 0.22,  0.83,  0.114, 0.41,  0.875,
      0.953, 0.61,  0.122, 0.989, 0.537, 0.099, 0.983, 0.757, 0.021, 0.195, 0.138,
      0.598, 0.954, 0.209, 0.826, 0.802, 0.841, 0.67,  0.984, 0.164, 0.025, 0.735,
      0.04,  0.867, 0.529, 0.015, 0.236, 0.021, 0.445, 0.768, 0.795, 0.399, 0.332,
      0.57,  0.903, 0.049, 0.738, 0.943, 0.13,  0.918, 0.962, 0.346, 0.733, 0.728};
  const Rips complex(DistanceMatrix(12, lower));
  for (const std::int64_t field : {2, 3, 5, 7}) {
    Counts counts;
    Options options;
    options.field = field;
    check_loops(complex, options, counts);
    EXPECT_GT(counts.shortest, 0);
  }
}

TEST(Loops, AreShortestInRandomPoints) {
  Counts counts;
  for_each_seed(600, [&](Generator& random, bool ties, std::int64_t) {
    RipsOptions rips;
    rips.merge_equal_points = random.coin();
    if (random.integer(0, 2) == 0) rips.threshold = ties ? random.integer(1, 3) : random.real();
    const Rips complex(random.points(random.integer(5, 13), random.integer(2, 3), ties), rips);
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 200)) << counts.bars;
}

TEST(Loops, AreShortestInSparseDistances) {
  Counts counts;
  for_each_seed(600, [&](Generator& random, bool ties, std::int64_t) {
    const Rips complex(random.sparse(random.integer(5, 10), ties, 0.5));
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 300)) << counts.bars;
}

TEST(Loops, KeepTheNumbersOfPointsThatAreLeft) {
  Counts counts;
  for_each_seed(200, [&](Generator& random, bool ties, std::int64_t) {
    const DistanceMatrix distances = random.distances(12, ties);
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < 12; ++v)
      if (random.integer(0, 3) > 0) vertices.push_back(v);
    std::vector<double> births(12);
    for (double& b : births) b = random.value(ties);
    RipsOptions rips;
    rips.vertices = vertices;
    if (random.coin()) rips.births = births;
    const Rips complex(distances, rips);
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 100)) << counts.bars;
}

TEST(Loops, OfSparseRipsFiltrations) {
  Counts counts;
  for_each_seed(100, [&](Generator& random, bool, std::int64_t) {
    RipsOptions rips;
    rips.approximation = 0.5 + random.real();
    const Rips complex(random.points(random.integer(5, 13), 2, false), rips);
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 20)) << counts.bars;
}

// Two rings joined by a tube. One of the bars is represented only by the difference of two walks.
TEST(Loops, MayNeedTwoWalks) {
  Points points(16, 3);
  for (Index i = 0; i < 8; ++i) {
    const double angle = 0.78539816339744830962 * static_cast<double>(i);
    points.set_row(i, {std::cos(angle), std::sin(angle), 0});
    points.set_row(8 + i, {1.02 * std::cos(angle), 1.02 * std::sin(angle), 0.9});
  }
  const Rips rips(points);
  for (const std::int64_t field : kFields) {
    const Options options{.field = field, .representatives = Representatives::cycles};
    const Barcode bars = persistence(rips, options);
    const auto found = loops(rips, bars, options);
    Counts counts;
    check_loops(rips, options, counts);
    bool two = false;
    for (const BarLoops& of_bar : found) two |= of_bar.loops.size() == 2;
    EXPECT_TRUE(two);
    EXPECT_EQ(counts.locally, 1);
    EXPECT_EQ(found[bars.longest(1)].loops.size(), 1u);
  }
}

TEST(Loops, StayAsTheyAreWithoutMemory) {
  Generator random(1);
  const Rips rips(random.points(60, 2, false));
  const Options options{.representatives = Representatives::cycles};
  const Barcode bars = persistence(rips, options);
  for (std::size_t limit = 1; limit < (std::size_t{1} << 26); limit *= 2) {
    LimitedContext context(limit);
    try {
      const auto found = loops(rips, bars, options, true, context);
      for (std::size_t i = 0; i < bars.size(); ++i)
        EXPECT_EQ(found[i].loops.empty(), bars[i].dim != 1);
      EXPECT_LE(context.memory.peak(), limit);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::resource);
      EXPECT_LT(limit, std::size_t{1} << 16);
    }
    EXPECT_EQ(context.memory.used(), 0u);
  }
}

TEST(Loops, StopWhenAsked) {
  Generator random(1);
  const Rips rips(random.points(60, 2, false));
  const Options options{.representatives = Representatives::cycles};
  const Barcode bars = persistence(rips, options);
  StoppedContext context;
  expect_error(ErrorKind::cancelled, {}, [&] { loops(rips, bars, options, true, context); });
}

TEST(Loops, NeedCycles) {
  Generator random(1);
  const Rips rips(random.points(9, 2, false));
  expect_error(ErrorKind::usage, "without cycles", [&] { loops(rips, persistence(rips)); });
  const Barcode cocycles = persistence(rips, {.representatives = Representatives::cocycles});
  expect_error(ErrorKind::usage, "without cycles", [&] { loops(rips, cocycles); });
  const Barcode cycles = persistence(rips, {.representatives = Representatives::cycles});
  const Rips other(Points(random.points(2, 2, false)));
  // Without points, there is no bar that could have a loop.
  EXPECT_TRUE(loops(Rips(Points(0, 2)), persistence(Rips(Points(0, 2)))).empty());
  if (!cycles.bars(1).empty())
    expect_error(ErrorKind::usage, "an edge that is not in this complex",
                 [&] { loops(other, cycles); });
}

}  // namespace
}  // namespace ph::test
