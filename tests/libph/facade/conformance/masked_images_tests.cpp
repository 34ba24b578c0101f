// SPDX-License-Identifier: MIT
// Images with a mask: compares every engine with the oracle, which gets a list of the cubes that
// follows the definition.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/complex/listed_cubes.hpp"
#include "ph/detail/core/file_pages.hpp"
#include "ph/explicit.hpp"
#include "ph/merge_tree.hpp"
#include "ph/voxel_image.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {
namespace {

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

/// A small image in which some voxels are absent and some voxels have the value infinity.
Image masked_image(Generator& random, const std::vector<Index>& extents, bool ties) {
  Image image = random.image(extents, ties);
  const int share = random.integer(1, 6);
  image.values.change([&](auto& all) {
    using T = typename std::remove_cvref_t<decltype(all)>::value_type;
    for (auto& v : all)
      if (random.integer(0, 9) < share) v = static_cast<T>(kAbsent);
  });
  image.masked = true;
  return image;
}

std::vector<Index> random_extents(Generator& random, int most_axes) {
  const int axes = random.integer(1, most_axes);
  constexpr int kMost[] = {0, 12, 5, 4, 2};
  std::vector<Index> extents;
  for (int k = 0; k < axes; ++k) extents.push_back(random.integer(1, kMost[axes]));
  return extents;
}

/// The same image with its numbers in another type, or in memory that is marked as a file.
Image stored_otherwise(Generator& random, const Image& image) {
  Image other = image;
  const std::vector<double> numbers = image.values.doubles();
  if (random.coin()) other.values = std::vector<float>(numbers.begin(), numbers.end());
  if (random.integer(0, 7) == 0) {
    // Copies the values to a mapped file, whose pages are released during the computation.
    const std::size_t bytes = other.values.size() * bytes_of(other.values.type());
    auto file = std::make_shared<ScratchFile>(bytes);
    std::memcpy(file->data(), other.values.data(), bytes);
    other.values =
        Voxels(BorrowedVoxels{other.values.type(), file->data(), numbers.size(), file, true});
  }
  return other;
}

TEST(MaskedImages, AreWhatTheDefinitionSays) {
  for_each_seed(8000, [](Generator& random, bool ties, std::int64_t field) {
    const std::vector<Index> extents = random_extents(random, 4);
    const Image image = masked_image(random, extents, ties);
    CubicalOptions options = random.cubical_options(static_cast<int>(extents.size()));
    if (random.integer(0, 3) == 0) options.threshold = random.integer(-1, 2);
    const Image stored = stored_otherwise(random, image);
    Image listed = image;
    listed.values = stored.values.doubles();  // the numbers after a possible conversion to floats
    const int max_dim = static_cast<int>(extents.size());
    const Barcode oracle =
        persistence(listed_cubes(listed, options),
                    {.max_dim = max_dim, .field = field, .engine = Engine::standard});
    RunContext context;
    context.slab_layers = random.integer(0, 3);
    const Cubical cubical(stored, options, context);
    for (const auto& engine : detail::engines<Cubical>()) {
      SCOPED_TRACE(engine.id.name());
      if (!engine.can_run(cubical, Task{.max_dim = max_dim})) continue;
      for (const bool cells : {false, true}) {
        const Options how{.max_dim = max_dim, .field = field, .engine = engine.id, .cells = cells};
        EXPECT_EQ(first_difference(persistence(cubical, how, context), oracle), "");
      }
    }
  });
}

TEST(MaskedImages, PassTheSuite) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t field) {
    const std::vector<Index> extents = random_extents(random, 3);
    const Image image = masked_image(random, extents, ties);
    const CubicalOptions options = random.cubical_options(static_cast<int>(extents.size()));
    check(Cubical(image, options), static_cast<int>(extents.size()), {field});
    check(listed_cubes(image, options), static_cast<int>(extents.size()), {field});
  });
}

TEST(MaskedImages, AbsentIsNotInfinite) {
  Image image{{4}, {1, kAbsent, kInfinity, 0.5}};
  EXPECT_ANY_THROW(Cubical{image});
  expect_error(ErrorKind::bad_data, "voxel 1: found nan", [&] { Cubical{image}; });
  image.masked = true;
  const auto bars = [&](const CubicalOptions& options) {
    const Barcode barcode = persistence(Cubical(image, options));
    return std::vector<Bar>(barcode.begin(), barcode.end());
  };
  EXPECT_EQ(bars({}), (std::vector<Bar>{{0, 0.5, kInfinity}, {0, 1, kInfinity}}));
  EXPECT_EQ(bars({.superlevel = true}),
            (std::vector<Bar>{{0, -kInfinity, kInfinity}, {0, -1, kInfinity}}));
}

TEST(MaskedImages, VoxelsWithoutPointsAreAbsent) {
  const Points points{{0.5}, {2.5}, {2.6}};
  for (const VoxelValue value : {VoxelValue::occupancy, VoxelValue::density})
    for (const bool superlevel : {false, true}) {
      const PointImage image = voxel_image(points, 1, value);
      const Barcode bars =
          persistence(Cubical(image.image, {.superlevel = superlevel}), {.max_dim = 1});
      ASSERT_EQ(bars.size(), 2U);
      for (const Bar& bar : bars) {
        EXPECT_TRUE(std::isfinite(bar.birth));
        EXPECT_TRUE(bar.is_infinite());
      }
    }
}

// In any complex, a cell with the value infinity is never born.
TEST(InfiniteBirths, AreNowhere) {
  const std::vector<double> values{kInfinity, 1, kInfinity, 0};
  SimplexList edges;
  edges.add(std::array<Index, 2>{0, 1}, 0);
  edges.add(std::array<Index, 2>{1, 2}, 0);
  edges.add(std::array<Index, 2>{1, 3}, 0);
  const std::vector<Bar> expected{{0, 0, kInfinity}};
  const auto bars_of = [](const Barcode& bars) {
    return std::vector<Bar>(bars.begin(), bars.end());
  };
  const ExplicitComplex star = lower_star(edges, values);
  for (const int max_dim : {0, 1})
    for (const auto& engine : detail::engines<ExplicitComplex>()) {
      if (!engine.can_run(star, Task{.max_dim = max_dim})) continue;
      const Barcode bars = persistence(star, {.max_dim = max_dim, .engine = engine.id});
      EXPECT_EQ(bars_of(bars), expected) << engine.id.name();
    }
  EXPECT_EQ(star.size(), 3U);
  const std::vector<WeightedEdge> graph{{0, 1, kInfinity}, {1, 2, kInfinity}, {1, 3, 2}};
  EXPECT_EQ(bars_of(persistence(FilteredGraph(values, graph))),
            (std::vector<Bar>{{0, 0, kInfinity}, {0, 1, 2}}));
  EXPECT_EQ(bars_of(persistence(FilteredGraph::lower_star(values, graph))), expected);
  const FilteredGraph never(std::vector<double>{kInfinity}, {});
  EXPECT_TRUE(persistence(never).empty());
  never.for_each_cell(0, [](std::uint32_t v) { ADD_FAILURE() << v << " enters"; });
  // Vertices that never enter keep their numbers in the tree.
  for (const MergeTree& tree :
       {merge_tree(star), merge_tree(FilteredGraph::lower_star(values, graph))}) {
    EXPECT_EQ(tree.births, values);
    ASSERT_EQ(tree.merges.size(), 1U);
    EXPECT_EQ(tree.merges[0].elder, 3);
    EXPECT_EQ(tree.merges[0].younger, 1);
  }
}

TEST(InfiniteBirths, AreNowhereInRandomComplexes) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t field) {
    SimplexList list = random.simplices(random.integer(1, 7), 3, random.integer(1, 6), ties);
    std::vector<double> sorted = list.values;
    std::sort(sorted.begin(), sorted.end());
    const double never_from =
        sorted[static_cast<std::size_t>(random.integer(0, static_cast<int>(sorted.size()) - 1))];
    SimplexList finite;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (list.values[i] < never_from)
        finite.add(list.simplex(i), list.values[i]);
      else
        list.values[i] = kInfinity;
    }
    const ExplicitComplex complex = ExplicitComplex::from_simplices(list);
    check(complex, 3, {field});
    const auto bars = [&](const ExplicitComplex& c) {
      return persistence(c, {.max_dim = 3, .field = field, .engine = Engine::standard});
    };
    EXPECT_EQ(first_difference(bars(complex), bars(ExplicitComplex::from_simplices(finite))), "");
  });
}

}  // namespace
}  // namespace ph::test
