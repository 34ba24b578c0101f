// SPDX-License-Identifier: MIT
// Images with more than three axes, whose cells are paired within the star of each vertex. Compares
// the pairs with the oracle cell by cell, and the homology with known spaces.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ph/detail/cubical/pair_voxels.hpp"
#include "ph/estimate.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

std::vector<Index> random_extents(Generator& random, int axes, int least, int most) {
  std::vector<Index> extents;
  for (int k = 0; k < axes; ++k) extents.push_back(random.integer(least, most));
  return extents;
}

/// Images with a few values, with 256 values, or with only different values. Some voxels never
/// enter.
Image any_image(Generator& random, const std::vector<Index>& extents) {
  Image image = random.image(extents, random.coin());
  if (random.coin()) return image;
  const int most = random.coin() ? 255 : 2;
  std::vector<std::uint8_t> bytes(image.values.size());
  for (std::uint8_t& v : bytes) v = static_cast<std::uint8_t>(random.integer(0, most));
  return {extents, std::move(bytes)};
}

TEST(ManyAxes, AgreeWithTheOracleCellByCell) {
  std::size_t found_in_all = 0;
  for_each_seed(600, [&](Generator& random) {
    const int axes = random.integer(0, 9) == 0 ? random.integer(5, 6) : 4;
    const Image image = any_image(random, random_extents(random, axes, 1, axes == 4 ? 3 : 2));
    CubicalOptions options = random.cubical_options(axes);
    if (random.integer(0, 3) == 0) options.threshold = random.integer(-2, 200);
    const Cubical cubical(image, options);
    const int max_dim = random.coin() ? axes : random.integer(0, axes);
    const int min_dim = random.coin() ? 0 : random.integer(0, max_dim);
    RunContext context;
    context.slab_layers = random.integer(0, 2);
    for (const std::int64_t field : {2, 3}) {
      const auto bars = [&](Engine engine) {
        return pairs_of(persistence(
            cubical, {.max_dim = max_dim, .min_dim = min_dim, .field = field, .engine = engine},
            context));
      };
      const auto found = bars(Engine::gradient);
      ASSERT_EQ(found, bars(Engine::standard));
      found_in_all += found.size();
    }
  });
  EXPECT_TRUE(is_enough(found_in_all, std::size_t{3000})) << found_in_all;
}

// Compares larger images with the reduction of the boundary matrix. Columns are added to each
// other, and threads take each other's pivots.
TEST(ManyAxes, AgreeOnLargerImages) {
  for_each_seed(12, [&](Generator& random) {
    const Image image = any_image(random, random_extents(random, 4, 5, 8));
    const CubicalOptions choices = random.cubical_options(4);
    const std::int64_t field = random.coin() ? 2 : 5;
    std::vector<std::vector<Pair>> results;
    for (const int threads : {1, 2, 5}) {
      ThreadsContext context(threads);
      const Cubical cubical(image, choices, context);
      results.push_back(
          pairs_of(persistence(cubical, {.field = field, .engine = Engine::gradient}, context)));
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
    EXPECT_EQ(results[0], pairs_of(persistence(Cubical(image, choices),
                                               {.field = field, .engine = Engine::twist})));
  });
}

TEST(ManyAxes, KnownSpaces) {
  std::vector<double> from_sphere;
  for (Index i = 0; i < 11 * 11 * 11 * 11; ++i) {
    double square = 0;
    for (Index rest = i, k = 0; k < 4; ++k, rest /= 11)
      square += std::pow(static_cast<double>(rest % 11) - 5, 2);
    from_sphere.push_back(std::abs(std::sqrt(square) - 3));
  }
  for (const Construction construction : {Construction::vertices, Construction::cells})
    for (const std::int64_t field : {2, 3}) {
      const Options options{.field = field, .engine = Engine::gradient};
      const Cubical shell(Image{{11, 11, 11, 11}, from_sphere}, {.construction = construction});
      EXPECT_EQ(betti_at(persistence(shell, options), 1.1, 4), (std::vector<int>{1, 0, 0, 1, 0}));
      // Periodic axes of 1, 2 and 3 voxels.
      const Cubical torus(Image{{3, 1, 2, 3, 2}, std::vector<double>(36, 7)},
                          {.construction = construction, .periodic = std::vector<bool>(5, true)});
      EXPECT_EQ(betti_at(persistence(torus, options), 7, 5),
                (std::vector<int>{1, 5, 10, 10, 5, 1}));
      const Cubical ring(Image{{2, 3, 2, 3}, std::vector<double>(36, 7)},
                         {.construction = construction, .periodic = {true, true, true, false}});
      EXPECT_EQ(betti_at(persistence(ring, options), 7, 4), (std::vector<int>{1, 3, 3, 1, 0}));
    }
}

TEST(ManyAxes, AreTakenWhereTheyCan) {
  const Cubical deep(Image{{2, 2, 2, 2}, std::vector<double>(16, 0.0)});
  EXPECT_EQ(plan(deep, {}).options.engine, Engine::gradient);
  EXPECT_EQ(plan(deep, {.max_dim = 1}).options.engine, Engine::gradient);
  EXPECT_EQ(plan(deep, {.min_persistence = -1}).options.engine, Engine::twist);
  CubicalImage grid = deep.cubical_image();
  grid.periodic.assign(8, false);
  grid.extents.assign(8, 8);  // 15^8 cells
  EXPECT_TRUE(cubical::can_pair_voxels(grid, 8));
  grid.voxels_are_vertices = false;  // 17^8 cells
  EXPECT_FALSE(cubical::can_pair_voxels(grid, 8));
  EXPECT_TRUE(cubical::can_pair_voxels(grid, 0));  // only voxels and edges
}

TEST(ManyAxes, CellsOrNotTheBarsAreTheSame) {
  Generator random(4);
  const Cubical cubical(random.image({6, 5, 6, 7}, false));
  const Barcode with = persistence(cubical), without = persistence(cubical, {.cells = false});
  EXPECT_EQ(std::vector<Bar>(with.begin(), with.end()),
            std::vector<Bar>(without.begin(), without.end()));
}

// Under any limit, the computation either gives the right answer, or frees everything and reports
// that memory is short. A request to stop is obeyed at every stage.
TEST(ManyAxes, BudgetsAndStops) {
  const Image image = Generator(5).image({8, 9, 7, 8}, false);
  const auto run = [&](const RunContext& context) {
    return pairs_of(persistence(Cubical(image, {}, context), {.field = 3}, context));
  };
  std::size_t peak = 0;
  std::vector<Pair> expected;
  {
    RunContext context;
    expected = run(context);
    peak = context.memory.peak();
    EXPECT_EQ(context.memory.used(), 0U);
  }
  for (std::size_t k = 0; k <= 20; ++k) {
    LimitedContext context(peak * k / 20);
    fails_with(ErrorKind::resource, [&] { EXPECT_EQ(run(context), expected); });
    EXPECT_EQ(context.memory.used(), 0U);
  }
  const Cubical cubical(image);
  StoppedContext context;
  expect_error(ErrorKind::cancelled, "stopped", [&] { persistence(cubical, {}, context); });
}

TEST(ManyAxes, EstimatesHold) {
  Generator random(6);
  for (const Construction construction : {Construction::vertices, Construction::cells}) {
    ThreadsContext context(1);
    std::vector<double> noise(12 * 12 * 12 * 12);
    for (double& v : noise) v = random.real();
    const Cubical cubical(Image{{12, 12, 12, 12}, std::move(noise)}, {.construction = construction},
                          context);
    const Estimate said = estimate(cubical, {}, context);
    EXPECT_EQ(said.options.engine, Engine::gradient);
    persistence(cubical, {}, context);
    const auto peak = static_cast<double>(context.memory.peak());
    EXPECT_GE(peak, said.bytes_low);
    EXPECT_LE(peak, said.bytes_high);
  }
}

}  // namespace
}  // namespace ph::test
