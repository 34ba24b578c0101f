// SPDX-License-Identifier: MIT
// Images whose cells are paired voxel by voxel: compares the pairs with the oracle cell by cell.
// Covers all types of voxels, both constructions, holes, periodic axes, and the duality of the two
// constructions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <thread>

#include "tests/support/conformance.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

std::vector<Index> random_extents(Generator& random, int most_axes) {
  std::vector<Index> extents;
  const int axes = random.integer(1, most_axes);
  constexpr int kMostVoxels[] = {0, 14, 8, 5, 4};
  for (int k = 0; k < axes; ++k) extents.push_back(random.integer(1, kMostVoxels[axes]));
  return extents;
}

template <class T>
Image image_of(Generator& random, const std::vector<Index>& extents, int most) {
  std::size_t voxels = 1;
  for (const Index n : extents) voxels *= static_cast<std::size_t>(n);
  std::vector<T> values(voxels);
  for (T& v : values) v = static_cast<T>(random.integer(0, most));
  return {extents, std::move(values)};
}

Image image_of_type(Generator& random, const std::vector<Index>& extents) {
  const int most = random.coin() ? 255 : 3;
  switch (random.integer(0, 5)) {
    case 0:
      return image_of<std::uint8_t>(random, extents, most);
    case 1:
      return image_of<std::uint16_t>(random, extents, most);
    case 2:
      return image_of<std::int16_t>(random, extents, most);
    case 3:
      return image_of<float>(random, extents, most);
    default:
      return random.image(extents, random.coin());
  }
}

TEST(Gradient, AgreeWithTheOracleCellByCell) {
  std::size_t longer = 0;
  for_each_seed(1500, [&](Generator& random) {
    const std::vector<Index> extents = random_extents(random, 3);
    const int axes = static_cast<int>(extents.size());
    CubicalOptions options = random.cubical_options(axes);
    const Image image = image_of_type(random, extents);
    if (random.integer(0, 3) == 0) options.threshold = random.integer(-2, 200);
    const Cubical cubical(image, options);
    const int max_dim = random.integer(0, axes);
    for (const std::int64_t field : {2, 3}) {
      const auto bars = [&](Engine engine) {
        return pairs_of(
            persistence(cubical, {.max_dim = max_dim, .field = field, .engine = engine}));
      };
      const auto found = bars(Engine::gradient);
      ASSERT_EQ(found, bars(Engine::standard));
      longer += found.size();
    }
  });
  EXPECT_TRUE(is_enough(longer, std::size_t{3000})) << longer;
}

// Compares larger images with the reduction of the boundary matrix. In these images, loops have
// long boundaries, and columns are added to each other.
TEST(Gradient, AgreeOnLargerVolumes) {
  for_each_seed(24, [&](Generator& random) {
    const std::vector<Index> extents{random.integer(10, 16), random.integer(10, 16),
                                     random.integer(10, 16)};
    const Cubical cubical(image_of_type(random, extents), random.cubical_options(3));
    const std::int64_t field = random.coin() ? 2 : 5;
    const auto bars = [&](Engine engine) {
      return pairs_of(persistence(cubical, {.field = field, .engine = engine}));
    };
    ASSERT_EQ(bars(Engine::gradient), bars(Engine::twist));
  });
}

// If there are few critical cells, gradient paths are followed on demand instead of all at once.
TEST(Gradient, AgreeOnSmoothImages) {
  for_each_seed(40, [&](Generator& random) {
    const bool flat = random.coin();
    const std::vector<Index> extents =
        flat ? std::vector<Index>{90, 100} : std::vector<Index>{17, 18, 19};
    std::vector<std::array<double, 3>> centres(2);
    for (auto& centre : centres)
      for (double& x : centre) x = random.integer(2, 15);
    Image image{extents, std::vector<double>()};
    std::vector<double> values;
    for (Index z = 0; z < (flat ? 1 : extents[0]); ++z)
      for (Index y = 0; y < extents[flat ? 0 : 1]; ++y)
        for (Index x = 0; x < extents.back(); ++x) {
          double nearest = kInfinity;
          for (const auto& c : centres)
            nearest = std::min(
                nearest, std::hypot(static_cast<double>(z) - c[0], static_cast<double>(y) - c[1],
                                    static_cast<double>(x) - c[2]));
          values.push_back(nearest);
        }
    image.values = Voxels(std::move(values));
    const Cubical cubical(image, random.cubical_options(static_cast<int>(extents.size())));
    const auto bars = [&](Engine engine) {
      return pairs_of(persistence(cubical, {.engine = engine}));
    };
    ASSERT_EQ(bars(Engine::gradient), bars(Engine::twist));
  });
}

// The V-construction of f is dual to the T-construction of -f with an added border that enters
// first. Dimension d-1-k corresponds to k, and the two ends of each bar are swapped and negated.
// This does not hold for classes that never die.
TEST(Gradient, ConstructionsAreDual) {
  for_each_seed(300, [&](Generator& random) {
    const int axes = random.integer(1, 4);
    std::vector<Index> extents, padded;
    std::size_t voxels = 1;
    for (int k = 0; k < axes; ++k) {
      extents.push_back(random.integer(2, axes == 4 ? 4 : 5));
      padded.push_back(extents.back() + 2);
      voxels *= static_cast<std::size_t>(extents.back());
    }
    std::vector<double> values(voxels);
    for (double& v : values) v = random.value(random.coin());
    constexpr double border = 100;
    std::vector<double> around;
    std::vector<Index> at(static_cast<std::size_t>(axes), 0);
    for (bool more = true; more;) {
      std::size_t place = 0;
      bool inside = true;
      for (std::size_t k = 0; k < at.size(); ++k) {
        inside = inside && at[k] > 0 && at[k] <= extents[k];
        place = place * static_cast<std::size_t>(extents[k]) + static_cast<std::size_t>(at[k] - 1);
      }
      around.push_back(inside ? -values[place] : -border);
      std::size_t k = at.size();
      while (k > 0 && ++at[k - 1] == padded[k - 1]) at[--k] = 0;
      more = k > 0;
    }
    std::vector<Bar> direct, dual;
    const Barcode vertices = persistence(Cubical(Image{extents, values}));
    for (const Bar& bar : vertices)
      if (!bar.is_infinite()) direct.push_back(bar);
    const Barcode cells =
        persistence(Cubical(Image{padded, around}, {.construction = Construction::cells}));
    for (const Bar& bar : cells)
      if (!bar.is_infinite() && bar.birth > -border)
        dual.push_back({axes - 1 - bar.dim, -bar.death, -bar.birth});
    const auto before = [](const Bar& a, const Bar& b) {
      return std::tie(a.dim, a.birth, a.death) < std::tie(b.dim, b.birth, b.death);
    };
    std::ranges::sort(direct, before);
    std::ranges::sort(dual, before);
    // The highest value fills the border, which adds one bar in the highest dimension. This bar was
    // left out above.
    EXPECT_EQ(direct, dual);
  });
}

// A periodic axis of one voxel is a circle: each bar has a copy one dimension higher.
TEST(Gradient, CirclesRaiseDimensions) {
  std::size_t raised = 0;
  for_each_seed(200, [&](Generator& random) {
    std::vector<Index> extents{3, 4, 3};
    CubicalOptions options = random.cubical_options(3);
    for (int circles = random.integer(1, 2); circles > 0; --circles) {
      const int at = random.integer(0, static_cast<int>(extents.size()));
      extents.insert(extents.begin() + at, 1);
      options.periodic.insert(options.periodic.begin() + at, true);
    }
    const Cubical cubical(random.image(extents, random.coin()), options);
    for (int min_dim = 0; min_dim <= 4; ++min_dim) {
      const auto bars = [&](Engine engine) {
        return pairs_of(persistence(cubical, {.max_dim = 4, .min_dim = min_dim, .engine = engine}));
      };
      const auto found = bars(Engine::gradient);
      ASSERT_EQ(found, bars(Engine::standard)) << min_dim;
      raised += min_dim == 2 ? found.size() : 0;
    }
  });
  EXPECT_TRUE(is_enough(raised, std::size_t{1000})) << raised;
}

TEST(Gradient, SolidAndHollowTori) {
  const auto distance_to_circle = [](Index x, Index y, Index z) {
    const double from_axis = std::hypot(static_cast<double>(x) - 16, static_cast<double>(y) - 16);
    return std::hypot(from_axis - 9, static_cast<double>(z) - 6);
  };
  std::vector<double> solid, hollow;
  for (Index x = 0; x < 33; ++x)
    for (Index y = 0; y < 33; ++y)
      for (Index z = 0; z < 13; ++z) {
        solid.push_back(distance_to_circle(x, y, z));
        hollow.push_back(std::abs(solid.back() - 3));
      }
  for (const Construction construction : {Construction::vertices, Construction::cells}) {
    for (const std::int64_t field : {2, 3}) {
      const Options options{.field = field, .engine = Engine::gradient};
      const Cubical filled(Image{{33, 33, 13}, solid}, {.construction = construction});
      EXPECT_EQ(betti_at(persistence(filled, options), 4, 3), (std::vector<int>{1, 1, 0, 0}));
      const Cubical surface(Image{{33, 33, 13}, hollow}, {.construction = construction});
      EXPECT_EQ(betti_at(persistence(surface, options), 1.5, 3), (std::vector<int>{1, 2, 1, 0}));
    }
  }
}

// Any trefoil knot is a circle, and its complement has one loop and one void.
TEST(Gradient, AKnotAndWhatIsAroundIt) {
  constexpr Index width = 41, depth = 21;
  constexpr int steps = 400;
  std::vector<std::array<double, 3>> knot;
  for (int i = 0; i < steps; ++i) {
    const double t = 2 * std::numbers::pi * i / steps;
    knot.push_back({20 + 5 * (std::sin(t) + 2 * std::sin(2 * t)),
                    20 + 5 * (std::cos(t) - 2 * std::cos(2 * t)), 10 - 5 * std::sin(3 * t)});
  }
  std::vector<double> distance, nearness;
  for (Index x = 0; x < width; ++x)
    for (Index y = 0; y < width; ++y)
      for (Index z = 0; z < depth; ++z) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& p : knot)
          least = std::min(least,
                           std::hypot(static_cast<double>(x) - p[0], static_cast<double>(y) - p[1],
                                      static_cast<double>(z) - p[2]));
        distance.push_back(least);
        nearness.push_back(-least);
      }
  for (const Construction construction : {Construction::vertices, Construction::cells})
    for (const int layers : {0, 4}) {
      RunContext context;
      context.slab_layers = layers;
      const auto betti = [&](const std::vector<double>& values, double at) {
        const Cubical cubical(Image{{width, width, depth}, values}, {.construction = construction});
        return betti_at(persistence(cubical, {.engine = Engine::gradient}, context), at, 3);
      };
      EXPECT_EQ(betti(distance, 2), (std::vector<int>{1, 1, 0, 0}));
      EXPECT_EQ(betti(nearness, -2), (std::vector<int>{1, 1, 1, 0}));
    }
}

TEST(Gradient, AreTakenWhereTheyCan) {
  const Image flat{{2, 3}, {1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(plan(Cubical(flat), {}).options.engine, Engine::gradient);
  EXPECT_EQ(plan(Cubical(flat), {.max_dim = 0}).options.engine, Engine::gradient);
  // Axes of one voxel are not counted.
  const Image thin{{2, 1, 2, 1, 2}, std::vector<double>(8, 0.0)};
  EXPECT_EQ(plan(Cubical(thin), {}).options.engine, Engine::gradient);
  const Options cycles{.representatives = Representatives::cycles};
  EXPECT_EQ(plan(Cubical(flat), cycles).options.engine, Engine::gradient);
  const Options cocycles{.representatives = Representatives::cocycles};
  EXPECT_EQ(plan(Cubical(flat), cocycles).options.engine, Engine::cohomology);
}

TEST(Gradient, ThreadsDoNotMatter) {
  Generator random(7);
  std::vector<double> values(60 * 70 * 50);
  for (double& v : values) v = random.integer(0, 40);
  const Image image{{60, 70, 50}, values};
  for (const Construction construction : {Construction::vertices, Construction::cells}) {
    std::vector<std::vector<Pair>> results;
    for (const int threads : {1, 2, 3, 5, 8}) {
      ThreadsContext context(threads);
      const Cubical cubical(image, {.construction = construction}, context);
      results.push_back(pairs_of(persistence(cubical, {.max_dim = 2}, context)));
      EXPECT_EQ(results.front(), results.back()) << threads;
    }
  }
}

TEST(Gradient, LongRowsAreLookedAtInParts) {
  Generator random(8);
  for (const std::vector<Index>& extents : {std::vector<Index>{9001}, {3, 5000}, {2, 2, 4097}})
    for (const Construction construction : {Construction::vertices, Construction::cells})
      for (const bool periodic : {false, true}) {
        const Image image = image_of<std::uint8_t>(random, extents, 250);
        const Cubical cubical(image, {.construction = construction,
                                      .periodic = std::vector<bool>(extents.size(), periodic)});
        Options options{.engine = Engine::gradient};
        const Barcode barcode = persistence(cubical, options);
        options.engine = Engine::twist;
        EXPECT_EQ(pairs_of(barcode), pairs_of(persistence(cubical, options)));
      }
}

TEST(Gradient, ProgressComesFromOneThread) {
  Generator random(9);
  const Image image = image_of<std::uint16_t>(random, {120, 120, 120}, 60000);
  ThreadsContext context(4);
  const std::thread::id here = std::this_thread::get_id();
  std::vector<std::string> stages;
  context.on_progress = [&](const Progress& progress) {
    EXPECT_EQ(std::this_thread::get_id(), here);
    EXPECT_TRUE(progress.total == 0 || progress.done <= progress.total) << progress.stage;
    stages.emplace_back(progress.stage);
  };
  persistence(Cubical(image, {}, context), {}, context);
  EXPECT_FALSE(stages.empty());
}

TEST(Gradient, HolesTakeNoMemory) {
  Generator random(10);
  const std::vector<Index> extents{100, 100, 100};
  const Image image = image_of<std::uint8_t>(random, extents, 250);
  for (const Construction construction : {Construction::vertices, Construction::cells}) {
    ThreadsContext context(1);
    // The threshold leaves out nine tenths of the voxels.
    const Cubical cubical(image, {.construction = construction, .threshold = 25}, context);
    const std::size_t before = context.memory.used();
    persistence(cubical, {.max_dim = 0, .cells = false}, context);
    // Memory is needed for the star of each voxel, for the node of each voxel in the graph, and for
    // each critical cell.
    EXPECT_LE(context.memory.peak() - before, std::size_t{18'000'000});
  }
}

TEST(Gradient, VoxelsStayWhatTheyAre) {
  const Image bytes{{4}, std::vector<std::uint8_t>{3, 255, 0, 7}};
  EXPECT_EQ(bytes.values.type(), VoxelType::uint8);
  EXPECT_EQ(bytes.values.bytes(), 4U);
  EXPECT_EQ(bytes.values, (std::vector<double>{3, 255, 0, 7}));
  Voxels copy = bytes.values;
  copy.change([](auto& all) { all[0] = 9; });
  EXPECT_EQ(copy[0], 9);
  EXPECT_EQ(bytes.values[0], 3);
  EXPECT_EQ(Cubical(bytes).voxel_bytes(), 4U);
}

}  // namespace
}  // namespace ph::test
