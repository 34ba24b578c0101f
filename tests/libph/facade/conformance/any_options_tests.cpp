// SPDX-License-Identifier: MIT
// Combinations of options: runs small complexes of any kind with any options that the engines
// accept, and compares the bars with the oracle. The oracle computes all bars of positive length.
// Options that save work must not lose bars.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/conformance.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {
namespace {

constexpr int kSeeds = 1500;

/// The bars of the oracle that are selected by the options.
template <class Complex>
std::vector<Pair> expected_bars(const Complex& complex, const Options& options) {
  const Options all{.max_dim = options.max_dim, .field = options.field, .engine = Engine::standard};
  std::vector<Pair> pairs = pairs_of(persistence(complex, all));
  std::erase_if(pairs, [&](const Pair& p) {
    return p.bar.dim < options.min_dim ||
           (!p.bar.is_infinite() && p.bar.death - p.bar.birth <= options.min_persistence);
  });
  return pairs;
}

void forget_cells(std::vector<Pair>& pairs) {
  for (Pair& p : pairs) p.birth_cell = p.death_cell = {};
  std::sort(pairs.begin(), pairs.end());
}

/// @param engines engines for complexes of this kind. An engine need not support all options.
/// @return the number of bars that were compared.
template <class Complex>
std::size_t agree(Generator& random, const Complex& complex, const std::vector<Engine>& engines,
                  int top_dim) {
  constexpr std::array all_representatives{Representatives::none, Representatives::cycles,
                                           Representatives::cocycles, Representatives::voxels};
  Options options;
  options.max_dim = random.integer(0, top_dim);
  options.min_dim = random.coin() ? 0 : random.integer(0, *options.max_dim);
  options.field = std::array{2, 3, 5}[static_cast<std::size_t>(random.integer(0, 2))];
  options.engine =
      engines[static_cast<std::size_t>(random.integer(0, static_cast<int>(engines.size()) - 1))];
  options.min_persistence = random.coin() ? 0 : 0.3;
  options.collapse = std::array{Collapse::automatic, Collapse::on,
                                Collapse::off}[static_cast<std::size_t>(random.integer(0, 2))];
  if (random.integer(0, 3) == 0)
    options.representatives = all_representatives[static_cast<std::size_t>(random.integer(0, 3))];
  options.cells = options.representatives != Representatives::none || random.coin();
  RunContext context;
  context.threads = random.integer(1, 3);
  context.slab_layers = random.integer(0, 2);
  std::vector<Pair> found;
  try {
    found = pairs_of(persistence(complex, options, context));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();  // these options cannot be combined
    return 0;
  }
  std::vector<Pair> expected = expected_bars(complex, options);
  // If edges are collapsed, the bars may name different edges with the same value.
  if (!options.cells || options.collapse != Collapse::off) {
    forget_cells(found);
    forget_cells(expected);
  }
  EXPECT_EQ(found, expected) << "max_dim " << *options.max_dim << " min_dim " << options.min_dim
                             << " engine " << options.engine.name();
  return expected.size();
}

/// @param compare a function that compares a random complex with random options and returns the
/// number of bars.
template <class Compare>
void for_each_choice(Compare&& compare) {
  std::size_t bars = 0;
  for (std::uint64_t seed = 0; seed < kSeeds && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    bars += compare(random);
  }
  EXPECT_GT(bars, kSeeds);
}

Rips random_rips(Generator& random) {
  const Index n = random.integer(1, 12);
  const bool ties = random.coin();
  RipsOptions options;
  if (random.coin()) options.threshold = random.coin() ? 0.7 : 2;
  std::vector<double> births;
  if (random.integer(0, 3) == 0)
    for (Index i = 0; i < n; ++i) births.push_back(random.value(ties));
  options.births = births;
  switch (random.integer(0, 2)) {
    case 0:
      return Rips(random.points(n, random.integer(1, 3), ties), options);
    case 1:
      return Rips(random.distances(n, ties), options);
    default:
      return Rips(random.sparse(n, ties, random.real()), options);
  }
}

Cubical random_cubical(Generator& random) {
  constexpr std::array most{12, 7, 4, 3};
  const int axes = random.integer(1, 4);
  std::vector<Index> extents;
  for (int k = 0; k < axes; ++k)
    extents.push_back(random.integer(1, most[static_cast<std::size_t>(axes - 1)]));
  return Cubical(random.image(extents, random.coin()), random.cubical_options(axes));
}

TEST(AnyOptions, Rips) {
  for_each_choice([](Generator& random) {
    return agree(random, random_rips(random),
                 {Engine::automatic, Engine::automatic, Engine::edge_links, Engine::cohomology,
                  Engine::twist, Engine::union_find},
                 4);
  });
}

TEST(AnyOptions, Cubical) {
  for_each_choice([](Generator& random) {
    return agree(random, random_cubical(random),
                 {Engine::automatic, Engine::gradient, Engine::cohomology, Engine::twist,
                  Engine::union_find},
                 4);
  });
}

TEST(AnyOptions, Explicit) {
  for_each_choice([](Generator& random) {
    return agree(random, ExplicitComplex::from_simplices(random.simplices(8, 3, 12, random.coin())),
                 {Engine::automatic, Engine::cohomology, Engine::twist, Engine::union_find}, 4);
  });
}

}  // namespace
}  // namespace ph::test
