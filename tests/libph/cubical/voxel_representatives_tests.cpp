// SPDX-License-Identifier: MIT
// Representatives of the bars of images: checks cycles by the definition, and sets of voxels by
// flood fill.
#include <array>
#include <set>

#include "ph/eigen.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/random_images.hpp"
#include "tests/support/voxel_sets.hpp"

namespace ph::test {
namespace {

TEST(VoxelRepresentatives, CyclesFromTheDefinition) {
  for_each_seed(700, [](Generator& random, bool ties, std::int64_t field) {
    check_random_cycles(random, ties, field);
  });
}

TEST(VoxelRepresentatives, SetsByFloodFill) {
  for_each_seed(2000, [](Generator& random, bool ties, std::int64_t field) {
    check_random_sets(random, ties, field);
  });
}

// Tests all extents of one to three voxels along one to three axes. Any of the axes may be
// periodic.
TEST(VoxelRepresentatives, OfAllSmallShapes) {
  for_each_seed(4, [](Generator& random, bool ties, std::int64_t field) {
    for (std::size_t axes = 1; axes <= 3; ++axes) {
      std::vector<Index> extents(axes, 1);
      for (bool more = true; more;) {
        for (unsigned closed = 0; closed < 1U << axes; ++closed) {
          for (const auto construction :
               {CubicalOptions::Construction::vertices, CubicalOptions::Construction::cells}) {
            CubicalOptions options{.construction = construction, .superlevel = random.coin()};
            for (std::size_t k = 0; k < axes; ++k)
              options.periodic.push_back((closed >> k & 1U) != 0);
            SCOPED_TRACE(::testing::PrintToString(extents) + " periodic " + std::to_string(closed) +
                         (construction == CubicalOptions::Construction::cells ? " T" : " V"));
            check_sets(random.image(extents, ties), options, 3, field);
            if (::testing::Test::HasFailure()) return;
          }
        }
        std::size_t k = axes;
        while (k > 0 && ++extents[k - 1] == 4) extents[--k] = 1;
        more = k > 0;
      }
    }
  });
}

// A periodic axis of one voxel is a circle. A cycle can go around it, but no set of voxels
// surrounds it.
TEST(VoxelRepresentatives, ACircleOfOneVoxelIsGoneAroundByCycles) {
  const Image pair{{1, 2}, {1, 2}};
  const Barcode bars = persistence(Cubical(pair, {.periodic = {true}}),
                                   {.representatives = Representatives::voxels});
  ASSERT_EQ(bars.size(), 2U);  // a component, and a loop around the axis
  EXPECT_EQ(bars.voxels(0).size(), 2U);
  EXPECT_EQ(bars[1], (Bar{1, 1, kInfinity}));
  EXPECT_TRUE(bars.voxels(1).empty());
  EXPECT_GT(bars.representative(1).size(), 0U);
  // A ring that consists of all voxels of its row surrounds no voxel.
  const Image ring{{5, 1}, {1, 2, 3, 4, 5}};
  const Barcode around = persistence(
      Cubical(ring, {.construction = CubicalOptions::Construction::cells, .periodic = {true}}),
      {.representatives = Representatives::voxels});
  ASSERT_EQ(around.bars(1).size(), 1U);
  EXPECT_TRUE(around.voxels(1).empty());
  EXPECT_GT(around.representative(1).size(), 0U);
}

// Columns are added to each other, and paths through the forest are long. Even then, the
// representatives must be the same for any number of threads, have no boundary, and be born at the
// right value.
TEST(VoxelRepresentatives, CyclesOfLargerVolumes) {
  for_each_seed(8, [](Generator& random, bool ties, std::int64_t field) {
    const std::vector<Index> extents{12, 9, 11};
    const Image image = random.image(extents, ties);
    const CubicalOptions cubical_options = random.cubical_options(3);
    std::vector<std::vector<PositionChain>> found;
    for (const int threads : {1, 3}) {
      RunContext context;
      context.threads = threads;
      const Cubical cubical(image, cubical_options, context);
      const OrderedCells<Cubical> cells(cubical, 3, field);
      const Barcode bars = persistence(
          cubical, {.field = field, .representatives = Representatives::cycles}, context);
      EXPECT_GT(bars.bars(1).size(), 30U);
      auto& chains = found.emplace_back();
      for (std::size_t i = 0; i < bars.size(); ++i) {
        SCOPED_TRACE("bar " + std::to_string(i));
        chains.push_back(closed_cycle(cells, bars, i));
        ASSERT_FALSE(chains.back().empty());
        EXPECT_EQ(chains.back().rbegin()->first, cells.position(bars[i].dim, bars.birth_cell(i)));
      }
    }
    EXPECT_EQ(found[0], found[1]);
  });
}

TEST(VoxelRepresentatives, APitAndARing) {
  const Image image{{5, 6}, {9, 9, 9, 9, 9, 9,  //
                             9, 1, 1, 1, 9, 3,  //
                             9, 1, 7, 1, 9, 3,  //
                             9, 1, 1, 1, 9, 9,  //
                             9, 9, 9, 9, 9, 9}};
  const Barcode bars = persistence(Cubical(image), {.representatives = Representatives::voxels});
  ASSERT_EQ(bars.size(), 3U);  // the ring, which never dies; the pit; the hole of the ring
  EXPECT_EQ(bars.voxels(0).size(), 30U);
  const auto pit = bars.voxels(1);
  EXPECT_EQ(std::set<std::uint32_t>(pit.begin(), pit.end()), (std::set<std::uint32_t>{11, 17}));
  ASSERT_EQ(bars.voxels(2).size(), 1U);
  EXPECT_EQ(bars.voxels(2)[0], 14U);
  EXPECT_TRUE(std::ranges::equal(bars.birth_voxel(1), std::array<Index, 2>{1, 5}));
  EXPECT_TRUE(std::ranges::equal(bars.death_voxel(2), std::array<Index, 2>{2, 2}));
  EXPECT_TRUE(bars.death_voxel(0).empty());
}

TEST(VoxelRepresentatives, OnlyOfImagesWithPositiveLength) {
  const Options voxels{.representatives = Representatives::voxels};
  EXPECT_THROW(persistence(Rips(to_points(PointMatrix::Random(4, 2))), voxels), Error);
  const Image deep{{2, 2, 2, 2}, std::vector<double>(16, 0.0)};
  EXPECT_THROW(persistence(Cubical(deep), voxels), Error);
  const Image flat{{2, 2}, {1, 2, 3, 4}};
  Options zero_length = voxels;
  zero_length.min_persistence = -1;
  EXPECT_THROW(persistence(Cubical(flat), zero_length), Error);
  // Sets are computed even if cells are not requested.
  Options bare = voxels;
  bare.cells = false;
  EXPECT_EQ(persistence(Cubical(flat), bare).voxels(0).size(), 4U);
}

TEST(VoxelRepresentatives, CountInTheBudgetAndStop) {
  Generator random(3);
  const Image image = random.image({40, 40, 40}, false);
  RunContext context;
  const Cubical cubical(image, {}, context);
  for (const auto wanted : {Representatives::cycles, Representatives::voxels}) {
    context.memory.set_limit(context.memory.used() + 3'000'000);
    EXPECT_THROW(persistence(cubical, {.representatives = wanted}, context), Error);
    context.memory.set_limit(MemoryBudget::kUnlimited);
    const std::size_t before = context.memory.used();
    persistence(cubical, {.representatives = wanted}, context);
    EXPECT_EQ(context.memory.used(), before);
  }
  std::stop_source source;
  source.request_stop();
  context.stop = source.get_token();
  EXPECT_THROW(persistence(cubical, {.representatives = Representatives::voxels}, context), Error);
}

}  // namespace
}  // namespace ph::test
