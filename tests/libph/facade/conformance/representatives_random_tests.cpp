// SPDX-License-Identifier: MIT
// Checks cycles and cocycles of random small filtrations by their definitions.
#include "tests/support/for_each_seed.hpp"
#include "tests/support/representatives.hpp"

#include "ph/detail/rips/rips_filtration.hpp"

namespace ph::test {
namespace {

TEST(RandomRepresentatives, Rips) {
  for_each_seed(600, [](Generator& random, bool ties, std::int64_t field) {
    const int max_dim = random.integer(0, 2);
    RipsOptions options;
    if (random.coin()) options.threshold = ties ? random.integer(1, 3) : random.real();
    const Rips rips(random.distances(random.integer(1, 8), ties), options);
    with_all_edges(rips, max_dim, [&](const auto& f) { check_representatives(f, max_dim, field); });
  });
}

TEST(RandomRepresentatives, RipsSurfaces) {
  for_each_seed(100, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.distances(random.integer(8, 11), ties));
    with_all_edges(rips, 2, [&](const auto& f) { check_representatives(f, 2, field); });
  });
}

// A class of edges may lose a generator and get it back. Each of its edges must still occur only
// once.
TEST(RandomRepresentatives, RipsOfWideClasses) {
  for_each_seed(16, [](Generator& random, bool, std::int64_t field) {
    const Rips rips(random.distances(34, false));
    with_all_edges(rips, 1, [&]<class F>(const F& f) {
      const OrderedCells<F> cells(f, 2, field);
      for (const auto wanted : {Representatives::cycles, Representatives::cocycles}) {
        const Barcode bars = persistence(rips, {.field = field, .representatives = wanted});
        for (std::size_t i = 0; i < bars.size(); ++i)
          wanted == Representatives::cycles ? check_cycle(cells, bars, i)
                                            : check_cocycle(cells, bars, i);
      }
    });
  });
}

TEST(RandomRepresentatives, ComponentsOfAForestAreThoseOfTheWholeFiltration) {
  for_each_seed(1200, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random.points(random.integer(1, 9), random.integer(1, 3), ties);
    RipsOptions options;
    if (random.coin()) options.threshold = ties ? random.integer(1, 3) : random.real();
    const Rips rips(points, options);
    with_all_edges(rips, 0, [&]<class F>(const F& f) {
      const OrderedCells<F> cells(f, 1, field);
      for (const auto wanted : {Representatives::cycles, Representatives::cocycles}) {
        const Options task{
            .max_dim = 0, .field = field, .min_persistence = -1, .representatives = wanted};
        const RunPlan of_forest = plan(rips, task);
        ASSERT_EQ(of_forest.form, RipsForm::forest);
        const Barcode bars = run(rips, of_forest);
        for (std::size_t i = 0; i < bars.size(); ++i)
          wanted == Representatives::cycles ? check_cycle(cells, bars, i)
                                            : check_cocycle(cells, bars, i);
      }
    });
  });
}

TEST(RandomRepresentatives, Cubical) {
  for_each_seed(400, [](Generator& random, bool ties, std::int64_t field) {
    std::vector<Index> extents;
    const int dim = random.integer(1, 3);
    for (int k = 0; k < dim; ++k) extents.push_back(random.integer(1, dim == 3 ? 2 : 4));
    const Cubical cubical(random.image(extents, ties), random.cubical_options(dim));
    check_representatives(cubical, random.integer(0, dim), field);
  });
}

TEST(RandomRepresentatives, SimplicialComplexes) {
  for_each_seed(400, [](Generator& random, bool ties, std::int64_t field) {
    const auto list = random.simplices(random.integer(4, 7), 3, random.integer(1, 9), ties);
    check_representatives(ExplicitComplex::from_simplices(list), random.integer(0, 3), field);
  });
}

}  // namespace
}  // namespace ph::test
