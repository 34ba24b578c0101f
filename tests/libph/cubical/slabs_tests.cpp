// SPDX-License-Identifier: MIT
// Images of which a slab is seen at a time, against the same images seen whole: slabs of any
// height, all types of voxels, both constructions, holes, axes that close up.
#include <gtest/gtest.h>

#include "support/conformance.hpp"
#include "support/for_each_seed.hpp"
#include "support/generators.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

std::vector<Pair> bars_in_slabs(const Cubical& cubical, Options options, int layers,
                                int threads = 1) {
  RunContext context;
  context.threads = threads;
  context.slab_layers = layers;
  options.engine = Engine::gradient;
  return pairs_of(persistence(cubical, options, context));
}

template <class T>
Image random_image(Generator& random, const std::vector<Index>& extents, int most) {
  std::size_t voxels = 1;
  for (const Index n : extents) voxels *= static_cast<std::size_t>(n);
  std::vector<T> values(voxels);
  for (T& v : values) v = static_cast<T>(random.integer(0, most));
  return {extents, std::move(values)};
}

TEST(Slabs, AgreeWithTheOracleCellByCell) {
  std::size_t longer = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    const int axes = random.integer(2, 3), most = axes == 2 ? 9 : 5;
    std::vector<Index> extents;
    for (int k = 0; k < axes; ++k) extents.push_back(random.integer(1, most));
    CubicalOptions options = random.cubical_options(axes);
    if (random.coin()) options.periodic[0] = true;
    const Image image = random.coin()
                            ? random_image<std::uint8_t>(random, extents, random.coin() ? 255 : 3)
                            : random.image(extents, random.coin());
    if (random.integer(0, 3) == 0) options.threshold = random.integer(-2, 200);
    const Cubical cubical(image, options);
    const Options wanted{.max_dim = random.integer(0, axes),
                         .min_dim = random.coin() ? 0 : random.integer(0, axes),
                         .field = random.coin() ? 2 : 3};
    Options oracle = wanted;
    oracle.engine = Engine::standard;
    const auto expected = pairs_of(persistence(cubical, oracle));
    // 0: not in slabs.
    for (int layers = 0; layers <= extents[0]; ++layers)
      ASSERT_EQ(bars_in_slabs(cubical, wanted, layers), expected) << layers;
    longer += expected.size();
  }
  EXPECT_TRUE(is_enough(longer, std::size_t{1500})) << longer;
}

TEST(Slabs, HeightAndThreadsDoNotMatter) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    const bool flat = random.coin();
    const std::vector<Index> extents =
        flat ? std::vector<Index>{60, 70} : std::vector<Index>{21, 14, 17};
    const Image image = random.coin() ? random_image<std::uint8_t>(random, extents, 40)
                                      : random_image<float>(random, extents, 30000);
    const CubicalOptions options = random.cubical_options(static_cast<int>(extents.size()));
    const Cubical cubical(image, options);
    const auto expected = bars_in_slabs(cubical, {}, 0);
    for (const int layers : {1, 2, 3, 5, 11, 20, 60})
      for (int threads = 1; threads <= 8; ++threads)
        ASSERT_EQ(bars_in_slabs(cubical, {}, layers, threads), expected) << layers;
  }
}

TEST(Slabs, AreTakenWhereMemoryIsShort) {
  Generator random(3);
  std::vector<double> values;
  for (Index z = 0; z < 120; ++z)
    for (Index y = 0; y < 100; ++y)
      for (Index x = 0; x < 100; ++x)
        values.push_back(std::sin(0.2 * static_cast<double>(x)) *
                             std::sin(0.17 * static_cast<double>(y)) +
                         std::cos(0.13 * static_cast<double>(z)));
  const Image image{{120, 100, 100}, std::move(values)};
  for (const CubicalOptions& options :
       {CubicalOptions{.construction = Construction::vertices},
        CubicalOptions{.construction = Construction::cells},
        CubicalOptions{.construction = Construction::vertices, .periodic = {true, false, false}}}) {
    RunContext context, tight;
    const Cubical whole(image, options, context);
    const auto expected = pairs_of(persistence(whole, {}, context));
    const std::size_t taken = context.memory.peak();
    tight.memory.set_limit(image.values.bytes() + 5'000'000);
    EXPECT_LT(tight.memory.limit(), taken);
    const Cubical same(image, options, tight);
    EXPECT_EQ(pairs_of(persistence(same, {}, tight)), expected);
    EXPECT_LE(tight.memory.peak(), tight.memory.limit());
  }
}

// Noise has more critical cells than voxels: loops do not fit, all else does.
TEST(Slabs, SayWhenLoopsDoNotFit) {
  Generator random(4);
  const Image image = random_image<std::uint16_t>(random, {150, 60, 60}, 60000);
  RunContext context;
  context.memory.set_limit(image.values.bytes() + 10'000'000);
  const Cubical cubical(image, {}, context);
  try {
    persistence(cubical, {.cells = false}, context);
    FAIL() << "loops fit";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::resource);
    EXPECT_NE(std::string(error.what()).find("dimension 1"), std::string::npos) << error.what();
  }
  for (const Options& others :
       {Options{.max_dim = 0, .cells = false}, Options{.min_dim = 2, .cells = false}}) {
    RunContext roomy;
    EXPECT_EQ(persistence(cubical, others, context).size(),
              persistence(Cubical(image, {}, roomy), others, roomy).size());
  }
}

}  // namespace
}  // namespace ph::test
