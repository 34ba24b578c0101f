// SPDX-License-Identifier: MIT
// Cycles of edges are split into closed walks. The tests check that the walks add up to the given
// chain, or to the representative of a bar.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "ph/loops.hpp"
#include "tests/libph/loops/loop_chains.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

InputChain chain_of(const std::vector<Index>& numbers, const std::vector<std::int64_t>& a,
                    CellKind kind = CellKind::vertices) {
  return InputChain(kind, numbers, a);
}

TEST(ClosedWalks, OfAnEight) {
  const std::vector<Index> edges{0, 1, 1, 2, 0, 2, 2, 3, 3, 4, 4, 5, 2, 5};
  const auto walks = closed_walks(chain_of(edges, std::vector<std::int64_t>(7, 1)), 2);
  ASSERT_EQ(walks.size(), 2u);
  EXPECT_EQ(walks[0], (Loop{{2, 3, 4, 5}, 1, {}}));
  EXPECT_EQ(walks[1], (Loop{{0, 1, 2}, 1, {}}));
}

TEST(ClosedWalks, WithCoefficients) {
  // Three paths from 0 to 9, each with coefficient 1. Modulo 3, their sum is a cycle.
  const std::vector<Index> edges{0, 1, 1, 9, 0, 2, 2, 9, 0, 3, 3, 9};
  const std::vector<std::int64_t> ones(6, 1);
  const InputChain chain = chain_of(edges, ones);
  const auto walks = closed_walks(chain, 3);
  EXPECT_EQ(sum_of(walks, 3), edges_of(chain, 3));
  EXPECT_EQ(walks.size(), 2u);
  // Traversed in the other direction, a walk has the opposite coefficient.
  const std::vector<Index> ring{0, 1, 1, 2, 0, 2};
  EXPECT_EQ(closed_walks(chain_of(ring, {2, 2, -2}), 7), (std::vector{Loop{{0, 1, 2}, 2, {}}}));
  EXPECT_EQ(closed_walks(chain_of(ring, {-2, -2, 2}), 7), (std::vector{Loop{{0, 2, 1}, 2, {}}}));
}

TEST(ClosedWalks, OfRandomCycles) {
  for_each_seed(1500, [](Generator& random, bool, std::int64_t p) {
    const int n = random.integer(3, 12);
    EdgeChain sum;
    for (int k = random.integer(1, 6); k > 0; --k) {
      std::vector<Index> walk;
      for (int i = random.integer(3, 9); i > 0; --i) {
        const Index v = random.integer(0, n - 1);
        if (walk.empty() || walk.back() != v) walk.push_back(v);
      }
      if (walk.front() == walk.back()) walk.pop_back();
      if (walk.size() < 2) continue;
      const EdgeChain one = sum_of({Loop{walk, random.integer(1, 10), {}}}, p);
      for (const auto& [ends, a] : one) add(sum, ends.first, ends.second, a, p);
    }
    std::vector<Index> numbers;
    std::vector<std::int64_t> coefficients;
    for (const auto& [ends, a] : sum) {
      numbers.insert(numbers.end(), {ends.first[0], ends.second[0]});
      coefficients.push_back(a);
    }
    const auto walks = closed_walks(chain_of(numbers, coefficients), p);
    EXPECT_EQ(sum_of(walks, p), sum);
    check_form(walks, 1, p);
    // The result does not depend on the order of the edges.
    std::vector<Index> reversed;
    for (std::size_t i = coefficients.size(); i-- > 0;)
      reversed.insert(reversed.end(), {numbers[2 * i], numbers[2 * i + 1]});
    std::ranges::reverse(coefficients);
    EXPECT_EQ(closed_walks(chain_of(reversed, coefficients), p), walks);
  });
}

TEST(ClosedWalks, RefuseWhatIsNoCycleOfEdges) {
  expect_error(ErrorKind::usage, "a boundary that is not zero", [] {
    closed_walks(chain_of({0, 1, 1, 2}, {1, 1}), 2);
  });
  expect_error(ErrorKind::usage, "a cycle over Z/5", [] {
    closed_walks(chain_of({0, 1, 1, 2, 0, 2}, {1, 1, 1}), 5);
  });
  expect_error(ErrorKind::usage, "3 vertices", [] { closed_walks(chain_of({0, 1, 2}, {1}), 2); });
  expect_error(ErrorKind::usage, "rows",
               [] { closed_walks(chain_of({0}, {1}, CellKind::row), 2); });
  expect_error(ErrorKind::usage, "a cube that is not an edge", [] {
    closed_walks(chain_of({1, 1}, {1}, CellKind::grid), 2);
  });
  expect_error(ErrorKind::usage, "a prime", [] { closed_walks(chain_of({}, {}), 4); });
  EXPECT_TRUE(closed_walks(chain_of({}, {}), 2).empty());
}

/// The sum of the loops of an image, as a chain of edges. Each edge is named by the doubled
/// coordinates of its midpoint.
std::map<std::vector<Index>, std::int64_t> grid_sum(const std::vector<Loop>& loops,
                                                    const std::vector<Index>& periods,
                                                    std::int64_t p) {
  std::map<std::vector<Index>, std::int64_t> sum;
  for (const Loop& loop : loops) {
    const auto v = vertices_of(loop, periods.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto& next = v[(i + 1) % v.size()];
      std::vector<Index> edge = v[i];
      int steps = 0;
      std::int64_t sign = 0;
      for (std::size_t k = 0; k < edge.size(); ++k) {
        EXPECT_EQ(v[i][k] % 2, 0) << "no vertex";
        Index step = next[k] - v[i][k];
        if (periods[k] > 0 && std::abs(step) == periods[k] - 2) step = step > 0 ? -2 : 2;
        if (step == 0) continue;
        ++steps;
        EXPECT_EQ(std::abs(step), 2);
        sign = step / 2;
        edge[k] += step / 2;
        if (periods[k] > 0) edge[k] = modulo(edge[k], periods[k]);
      }
      EXPECT_EQ(steps, 1);
      auto& a = sum[edge];
      a = modulo(a + sign * loop.coefficient, p);
      if (a == 0) sum.erase(edge);
    }
  }
  return sum;
}

TEST(ClosedWalks, OfImages) {
  int count = 0;
  for_each_seed(400, [&](Generator& random, bool ties, std::int64_t p) {
    const int dim = random.integer(2, 3);
    std::vector<Index> extents;
    for (int k = 0; k < dim; ++k) extents.push_back(random.integer(3, dim == 2 ? 6 : 4));
    const CubicalOptions how = random.cubical_options(dim);
    const Cubical cubical(random.image(extents, ties), how);
    const Options options{.max_dim = 1, .field = p, .representatives = Representatives::cycles};
    const Barcode bars = persistence(cubical, options);
    const auto found = loops(cubical, bars, options);
    std::vector<Index> periods(extents.size(), 0);
    for (std::size_t k = 0; k < how.periodic.size(); ++k)
      if (how.periodic[k]) periods[k] = 2 * extents[k];
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_EQ(found[i].tightness, Tightness::none);
      if (bars[i].dim != 1) {
        EXPECT_TRUE(found[i].loops.empty());
        continue;
      }
      ++count;
      const InputChain chain = bars.representative(i);
      std::map<std::vector<Index>, std::int64_t> want;
      for (std::size_t k = 0; k < chain.size(); ++k) {
        const auto numbers = chain.cell(k).numbers;
        want[{numbers.begin(), numbers.end()}] = modulo(chain.coefficient(k), p);
      }
      EXPECT_EQ(grid_sum(found[i].loops, periods, p), want);
      check_form(found[i].loops, extents.size(), p);
    }
  });
  EXPECT_TRUE(is_enough(count, 1000)) << count;
}

// On a short periodic axis, two vertices may be joined by several edges. Each step of a walk must
// be one of the edges.
TEST(ClosedWalks, OfShortPeriodicAxes) {
  for (const Index n : {1, 2}) {
    const Image image{{n, 3}, Voxels(std::vector<double>(static_cast<std::size_t>(3 * n), 1.0))};
    const Cubical cubical(image, {.periodic = {true, false}});
    const Options options{.representatives = Representatives::cycles};
    const Barcode bars = persistence(cubical, options);
    ASSERT_FALSE(bars.bars(1).empty());
    const auto found = loops(cubical, bars, options);
    const std::size_t i = bars.longest(1);
    std::size_t steps = 0;
    for (const Loop& loop : found[i].loops) steps += loop.numbers.size() / 2;
    EXPECT_EQ(steps, bars.representative(i).size());
  }
}

TEST(ClosedWalks, OfSimplicialComplexes) {
  int count = 0;
  for_each_seed(400, [&](Generator& random, bool ties, std::int64_t p) {
    const auto list = random.simplices(random.integer(4, 7), 2, random.integer(1, 9), ties);
    const auto complex = ExplicitComplex::from_simplices(list);
    const Options options{.max_dim = 1, .field = p, .representatives = Representatives::cycles};
    const Barcode bars = persistence(complex, options);
    const auto found = loops(complex, bars, options);
    for (std::size_t i = 0; i < bars.size(); ++i) {
      if (bars[i].dim != 1) continue;
      ++count;
      EXPECT_EQ(sum_of(found[i].loops, p), edges_of(bars.representative(i), p));
    }
  });
  EXPECT_TRUE(is_enough(count, 50)) << count;
}

// The cells of a boundary matrix have no vertices, so there are no walks.
TEST(ClosedWalks, OfABoundaryMatrixThereAreNone) {
  BoundaryMatrix matrix;
  for (const int dim : {0, 0, 0, 1, 1, 1}) matrix.dims.push_back(dim);
  matrix.rows = {0, 1, 1, 2, 0, 2};
  matrix.offsets = {0, 0, 0, 0, 2, 4, 6};
  const auto complex = ExplicitComplex::from_boundary(matrix);
  const Options options{.representatives = Representatives::cycles};
  const Barcode bars = persistence(complex, options);
  const auto found = loops(complex, bars, options);
  ASSERT_EQ(bars.bars(1).size(), 1u);
  EXPECT_TRUE(found[bars.longest(1)].loops.empty());
}

}  // namespace
}  // namespace ph::test
