// SPDX-License-Identifier: MIT
// Images that are read one slab at a time: compares the results with the results of the whole
// images. Covers slabs of any height, all types of voxels, both constructions, holes and periodic
// axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <tuple>
#include <utility>

#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

std::vector<Pair> bars_in_slabs(const Cubical& cubical, Options options, int layers,
                                int threads = 1) {
  ThreadsContext context(threads);
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
  for_each_seed(1000, [&](Generator& random) {
    const int axes = random.integer(1, 3), most = axes == 1 ? 30 : axes == 2 ? 9 : 5;
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
    // With 0 layers, the image is not cut into slabs.
    for (int layers = 0; layers <= extents[0]; ++layers)
      ASSERT_EQ(bars_in_slabs(cubical, wanted, layers), expected) << layers;
    longer += expected.size();
  });
  EXPECT_TRUE(is_enough(longer, std::size_t{1500})) << longer;
}

TEST(Slabs, HeightAndThreadsDoNotMatter) {
  for_each_seed(6, [&](Generator& random) {
    const std::vector<Index> extents = std::vector<std::vector<Index>>{
        {60, 70}, {21, 14, 17}, {4000}}[static_cast<std::size_t>(random.integer(0, 2))];
    const Image image = random.coin() ? random_image<std::uint8_t>(random, extents, 40)
                                      : random_image<float>(random, extents, 30000);
    const CubicalOptions options = random.cubical_options(static_cast<int>(extents.size()));
    const Cubical cubical(image, options);
    const auto expected = bars_in_slabs(cubical, {}, 0);
    for (const int layers : {1, 2, 3, 5, 11, 20, 60})
      for (int threads = 1; threads <= 8; ++threads)
        ASSERT_EQ(bars_in_slabs(cubical, {}, layers, threads), expected) << layers;
  });
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

// An image whose bytes are all 0. The bytes take no memory until they are written to.
Image zeros(std::vector<Index> extents) {
  std::size_t count = 1;
  for (const Index n : extents) count *= static_cast<std::size_t>(n);
  const std::shared_ptr<void> bytes(std::calloc(count, 1), std::free);
  return {std::move(extents), Voxels(BorrowedVoxels{VoxelType::uint8, bytes.get(), count, bytes})};
}
void set(const Image& image, Index place, std::uint8_t value) {
  static_cast<std::uint8_t*>(const_cast<void*>(image.values.data()))[place] = value;
}

// A bar as (birth, death, coordinate of the voxel where it is born).
using FarBar = std::tuple<double, double, Index>;
std::vector<FarBar> far_bars(const Image& image, const CubicalOptions& options) {
  LimitedContext context(image.values.bytes() + 20'000'000);
  const Barcode bars = persistence(Cubical(image, options, context), {}, context);
  std::vector<FarBar> found;
  for (std::size_t i = 0; i < bars.size(); ++i)
    found.emplace_back(bars[i].birth, bars[i].death, bars.birth_cell(i).numbers[0]);
  std::ranges::sort(found);
  return found;
}

// Long rows are processed in blocks of a few thousand voxels.
TEST(Slabs, HaveLongRows) {
  Generator random(8);
  for (const std::vector<Index>& extents :
       {std::vector<Index>{10'000}, std::vector<Index>{2, 9000}, std::vector<Index>{8193, 1}})
    for (const bool periodic : {false, true})
      for (const auto construction : {Construction::vertices, Construction::cells}) {
        CubicalOptions options{.construction = construction};
        options.periodic.assign(extents.size(), periodic);
        const Cubical cubical(random_image<std::uint8_t>(random, extents, 3), options);
        const auto expected = pairs_of(persistence(cubical, {.engine = Engine::twist}));
        for (const int layers : {0, 1, 5000}) {
          if (layers == 1 && extents[0] > 2) continue;
          ASSERT_EQ(bars_in_slabs(cubical, {}, layers), expected) << layers;
        }
      }
}

TEST(Slabs, HoldMoreVoxelsThanPlacesOf32BitsCount) {
  if (seeds(100) <= 100) GTEST_SKIP() << "takes twenty seconds: only in a long search";
  constexpr Index many = Index{1} << 31;
  const CubicalOptions peaks{.superlevel = true};
  const Image line = zeros({many + 200'000});
  for (const auto& [place, value] :
       {std::pair<Index, int>{10, 7}, {many - 1, 9}, {many + 5, 3}, {many + 199'999, 8}})
    set(line, place, static_cast<std::uint8_t>(value));
  EXPECT_EQ(far_bars(line, peaks), (std::vector<FarBar>{{-9, kInfinity, 2 * (many - 1)},
                                                        {-8, 0, 2 * (many + 199'999)},
                                                        {-7, 0, 20},
                                                        {-3, 0, 2 * (many + 5)}}));
}

TEST(Slabs, RefuseLoopsOfTooManyVoxels) {
  const Image volume = zeros({1 << 11, 1 << 10, (1 << 10) + 1});
  const Cubical cubical(volume);
  expect_error(
      ErrorKind::resource,
      "found 2149580800 voxels, expected fewer than about "
      "2^31; a larger image is possible for dimension 0 alone (max_dim 0), for dimension 2 "
      "alone (min_dim 2), and for all dimensions",
      [&] { persistence(cubical); });
}

// An image of noise has more critical cells than voxels. Memory is large enough for everything
// except its loops.
TEST(Slabs, SayWhenLoopsDoNotFit) {
  Generator random(4);
  const Image image = random_image<std::uint16_t>(random, {150, 60, 60}, 60000);
  LimitedContext context(image.values.bytes() + 10'000'000);
  const Cubical cubical(image, {}, context);
  expect_error(ErrorKind::resource, "dimension 1",
               [&] { persistence(cubical, {.cells = false}, context); });
  for (const Options& others :
       {Options{.max_dim = 0, .cells = false}, Options{.min_dim = 2, .cells = false}}) {
    RunContext roomy;
    EXPECT_EQ(persistence(cubical, others, context).size(),
              persistence(Cubical(image, {}, roomy), others, roomy).size());
  }
}

}  // namespace
}  // namespace ph::test
