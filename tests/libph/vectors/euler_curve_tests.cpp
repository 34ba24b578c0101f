// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "ph/error.hpp"
#include "ph/euler_curve.hpp"
#include "ph/persistence.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/random_images.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

using test::expect_error;
using test::Generator;
using Construction = CubicalOptions::Construction;

/// The values at which Σ (-1)^dim over the living bars changes, with the changes.
std::map<double, std::int64_t> changes_of(const Barcode& bars) {
  std::map<double, std::int64_t> changes;
  for (const Bar& bar : bars) {
    const int sign = bar.dim % 2 == 0 ? 1 : -1;
    changes[bar.birth] += sign;
    if (!bar.is_infinite()) changes[bar.death] -= sign;
  }
  return changes;
}

StepFunction curve_of(const std::map<double, std::int64_t>& changes) {
  StepFunction curve;
  std::int64_t now = 0;
  for (const auto& [value, change] : changes) {
    if (change == 0) continue;
    curve.at.push_back(value);
    curve.value.push_back(now += change);
  }
  return curve;
}

/// Compares the Euler curve of an image with the curve of its bars, at the steps of the curve and
/// on grids, for any number of threads.
void check(const Image& image, const CubicalOptions& options) {
  const Cubical cubical(image, options);
  const Barcode bars = persistence(
      cubical,
      {.max_dim = std::max(cubical.top_dim(), 0), .engine = Engine::standard, .cells = false});
  const StepFunction expected = curve_of(changes_of(bars));
  for (const int threads : {1, 3}) {
    test::ThreadsContext context(threads);
    ASSERT_EQ(euler_curve(cubical, context), expected);
    ASSERT_EQ(context.memory.used(), 0U);
    for (const Grid& grid : {Grid{-1, 3, 9}, Grid{-2.5, 0.5, 50}, Grid{0.3, 0.3, 1}}) {
      std::vector<double> found(grid.points, -99), sampled(grid.points, -99);
      euler_curve(cubical, grid, found, context);
      expected.sample(grid, sampled);
      ASSERT_EQ(found, sampled);
    }
  }
  const std::vector<Bar> all(bars.begin(), bars.end());
  ASSERT_EQ(euler_curve(all), expected);
}

TEST(EulerCurves, OfImagesAreThoseOfTheirBars) {
  test::for_each_seed(4000, [](Generator& random, bool ties, std::int64_t) {
    const test::RandomImage image(random, ties, 5);
    check(image.image, image.options);
  });
}

/// Checks the Euler curve of a random image whose voxels are whole numbers of type T.
template <class T>
void check_type(Generator& random, bool ties) {
  const int axes = random.integer(1, 3);
  std::vector<Index> extents;
  std::size_t count = 1;
  for (int k = 0; k < axes; ++k) {
    extents.push_back(random.integer(1, axes == 3 ? 5 : 12));
    count *= static_cast<std::size_t>(extents.back());
  }
  const auto low = static_cast<int>(std::numeric_limits<T>::min()),
             high = static_cast<int>(std::numeric_limits<T>::max());
  std::vector<T> voxels(count);
  for (T& v : voxels) {
    v = static_cast<T>(ties ? random.integer(0, 3) : random.integer(low, high));
    if (random.integer(0, 5) == 0) v = static_cast<T>(random.coin() ? low : high);
  }
  CubicalOptions options = random.cubical_options(axes);
  if (random.integer(0, 3) == 0) options.threshold = random.integer(options.superlevel ? -3 : 0, 2);
  check({extents, voxels}, options);
}

TEST(EulerCurves, OfAllTypesOfVoxels) {
  test::for_each_seed(1500, [](Generator& random, bool ties, std::int64_t) {
    check_type<std::uint8_t>(random, ties);
    check_type<std::uint16_t>(random, ties);
    check_type<std::int16_t>(random, ties);
  });
  test::for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    Image image = random.image({random.integer(1, 5), random.integer(1, 5)}, ties);
    std::vector<float> floats;
    for (const double v : image.values) floats.push_back(static_cast<float>(v));
    image.values = floats;
    check(image, random.cubical_options(2));
  });
}

TEST(EulerCurves, OfManyAxes) {
  test::for_each_seed(60, [](Generator& random, bool ties, std::int64_t) {
    const int axes = random.integer(4, 5);
    std::vector<Index> extents;
    for (int k = 0; k < axes; ++k) extents.push_back(random.integer(1, axes == 4 ? 3 : 2));
    check(random.image(extents, ties), random.cubical_options(axes));
  });
  for (const auto construction : {Construction::vertices, Construction::cells}) {
    Generator random(1);
    const std::vector<Index> extents = {2, 2, 1, 2, 1, 2, 2};
    check(random.image(extents, true), {.construction = construction});
    check(
        random.image(extents, true),
        {.construction = construction, .periodic = {true, false, true, false, false, true, false}});
  }
}

/// The Euler curve by a simple method for either construction: computes the values of all cells of
/// the doubled grid and counts the cells.
StepFunction by_all_cells(const Image& image, bool vertices) {
  const Index n = image.extents[0], m = image.extents[1];
  std::map<double, std::int64_t> changes;
  const Index low = vertices ? 0 : -1;
  for (Index i = low; i <= 2 * n - 2 - low; ++i)
    for (Index j = low; j <= 2 * m - 2 - low; ++j) {  // voxels have even coordinates
      double value = vertices ? -kInfinity : kInfinity;
      for (Index a = std::max<Index>(0, i / 2); a <= std::min(n - 1, (i + 1) / 2); ++a)
        for (Index b = std::max<Index>(0, j / 2); b <= std::min(m - 1, (j + 1) / 2); ++b) {
          const double v = image.values[static_cast<std::size_t>(a * m + b)];
          value = vertices ? std::max(value, v) : std::min(value, v);
        }
      const bool is_even = (i + j) % 2 == 0;
      changes[value] += is_even ? 1 : -1;
    }
  return curve_of(changes);
}

TEST(EulerCurves, OfImagesOfManyPieces) {
  Generator random(7);
  for (const auto& extents :
       std::vector<std::vector<Index>>{{1500, 700}, {3, 2100}, {2500, 3}, {40'000, 5}}) {
    const auto count = static_cast<std::size_t>(extents[0] * extents[1]);
    std::vector<std::uint8_t> bytes(count);
    std::vector<std::uint16_t> words(count);
    std::vector<float> floats(count);
    for (std::size_t i = 0; i < count; ++i) {
      bytes[i] = static_cast<std::uint8_t>(random.integer(0, 255));
      words[i] = static_cast<std::uint16_t>(random.integer(0, 999));
      floats[i] = static_cast<float>(random.integer(0, 99'999)) / 64;
    }
    for (const Voxels& voxels : {Voxels(bytes), Voxels(words), Voxels(floats)}) {
      const Image image{extents, voxels};
      for (const bool vertices : {true, false}) {
        const Cubical cubical(
            image, {.construction = vertices ? Construction::vertices : Construction::cells});
        const StepFunction expected = by_all_cells(image, vertices);
        RunContext context;
        for (const int threads : {1, 2, 5}) {
          context.threads = threads;
          ASSERT_TRUE(euler_curve(cubical, context) == expected) << extents[0] << " " << threads;
        }
        const std::size_t layer = static_cast<std::size_t>(extents[1]) * bytes_of(voxels.type());
        EXPECT_GT(context.memory.peak(), 3 * layer);
        EXPECT_LT(context.memory.peak(), 24U << 20);
      }
    }
  }
}

TEST(EulerCurves, OfKnownImages) {
  const Image ring{{3, 3}, std::vector<double>{0, 1, 0, 1, 5, 1, 0, 1, 0}};
  EXPECT_EQ(euler_curve(Cubical(ring)), (StepFunction{{0, 1, 5}, {4, 0, 1}}));
  EXPECT_EQ(euler_curve(Cubical(ring, {.construction = Construction::cells})),
            (StepFunction{{0, 1, 5}, {4, 0, 1}}));
  EXPECT_EQ(euler_curve(Cubical(ring, {.superlevel = true})), (StepFunction{{-5}, {1}}));
  const Image point{{}, std::vector<double>{3}};
  EXPECT_EQ(euler_curve(Cubical(point)), (StepFunction{{3}, {1}}));
  EXPECT_EQ(euler_curve(Cubical(Image{{4}, std::vector<double>(4, 2)}, {.periodic = {true}})),
            StepFunction());
  EXPECT_EQ(euler_curve(Cubical(Image{{2}, {std::nan(""), 1}, true})), (StepFunction{{1}, {1}}));
  EXPECT_EQ(euler_curve(Cubical(Image{})), StepFunction());
  std::vector<double> out(3, 7);
  euler_curve(Cubical(Image{}), {0, 1, 3}, out);
  EXPECT_EQ(out, std::vector<double>(3));
  EXPECT_FALSE(std::signbit(euler_curve(Cubical(Image{{1}, {-0.0}})).at[0]));
  const Image zero{{1}, std::vector<std::uint8_t>{0}};
  EXPECT_FALSE(std::signbit(euler_curve(Cubical(zero, {.superlevel = true})).at[0]));
}

TEST(EulerCurves, AreEvaluated) {
  const StepFunction curve{{-kInfinity, 1, 2}, {2, -1, 4}};
  EXPECT_EQ(curve(-1e300), 2);
  EXPECT_EQ(curve(0.99), 2);
  EXPECT_EQ(curve(1), -1);
  EXPECT_EQ(curve(1.5), -1);
  EXPECT_EQ(curve(2), 4);
  EXPECT_EQ(curve(kInfinity), 4);
  EXPECT_EQ(StepFunction()(0), 0);
  EXPECT_EQ((StepFunction{{1}, {3}}(0.5)), 0);
  std::vector<double> out(5);
  curve.sample({0, 2, 5}, out);
  EXPECT_EQ(out, (std::vector<double>{2, 2, -1, -1, 4}));
  const std::vector<Bar> bars = {{0, 0, kInfinity}, {1, 1, 2}, {2, 1, 3}, {1, 4, 4}, {0, 0, 2}};
  EXPECT_EQ(euler_curve(bars), (StepFunction{{0, 3}, {2, 1}}));
  EXPECT_EQ(euler_curve(std::span<const Bar>()), StepFunction());
}

TEST(EulerCurves, RefuseWhatMakesNoSenseAndStop) {
  const Image image{{300, 300, 20}, std::vector<float>(1'800'000)};
  const Cubical cubical(image);
  std::vector<double> out(3);
  expect_error(ErrorKind::usage, "grid: found", [&] { euler_curve(cubical, {1, 0, 3}, out); });
  expect_error(ErrorKind::usage, "expected 4", [&] { euler_curve(cubical, {0, 1, 4}, out); });
  expect_error(ErrorKind::usage, "expected 4", [&] { StepFunction().sample({0, 1, 4}, out); });
  expect_error(ErrorKind::usage, "2 places and 1 values", [] { StepFunction{{1, 2}, {3}}(1); });
  expect_error(ErrorKind::usage, "1 places and 2 values", [&] {
    StepFunction{{1}, {3, 4}}.sample({0, 1, 3}, out);
  });
  expect_error(ErrorKind::bad_data, "euler_curve: found a bar", [&] {
    euler_curve(std::vector<Bar>{{0, 2, 1}});
  });
  test::StoppableContext context;
  context.on_progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "Euler curve");
    context.request_stop();
  };
  expect_error(ErrorKind::cancelled, "stopped", [&] {
    for (int i = 0; i < 1000; ++i) euler_curve(cubical, context);
  });
  EXPECT_EQ(context.memory.used(), 0U);
  test::LimitedContext small(10'000);
  expect_error(ErrorKind::resource, "memory limit", [&] { euler_curve(cubical, small); });
}

}  // namespace
}  // namespace ph
